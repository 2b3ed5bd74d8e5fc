// MINRES on the indefinite system [K B^T; B 0] with a block diagonal preconditioner. It never needs
// K to be regular.
#pragma once

#include <mortise/operators/block_system.h>
#include <mortise/solvers/solve_report.h>
#include <mortise/solvers/solver_options.h>

namespace mortise
{
  /// Solve by preconditioned MINRES; the preconditioner is diag(A^, W)^{-1} with A^ a
  /// HierarchicalPreconditioner of K + J. See solve().
  SolveReport
  solve_saddle_point(const BlockSystem   &system,
                     const SolverOptions &options,
                     Vector              &u,
                     Vector              &lambda);
} // namespace mortise
