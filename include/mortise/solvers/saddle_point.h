// GMRES on the indefinite system [K B^T; B 0] with a block factorisation as
// preconditioner. It never needs K to be regular.
#pragma once

#include <mortise/operators/block_system.h>
#include <mortise/solvers/solve_report.h>
#include <mortise/solvers/solver_options.h>

namespace mortise
{
  /// Solve by preconditioned GMRES; the preconditioner takes a
  /// HierarchicalPreconditioner for K + J and the Schur complement of an
  /// InterfaceLifting. See solve().
  SolveReport
  solve_saddle_point(const BlockSystem   &system,
                     const SolverOptions &options,
                     Vector              &u,
                     Vector              &lambda);
} // namespace mortise
