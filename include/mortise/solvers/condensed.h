// Conjugate gradients on the subspace { u : B u = 0 }, the condensed system
// written without choosing pairs of slave and master dofs; without an
// interface, ordinary conjugate gradients. It never forms the condensed matrix.
#pragma once

#include <mortise/operators/block_system.h>
#include <mortise/solvers/solve_report.h>
#include <mortise/solvers/solver_options.h>

namespace mortise
{
  /// Solve by preconditioned conjugate gradients on the positive definite
  /// system that is left when the constraint B u = g has been eliminated;
  /// lambda is recovered at the end. See solve().
  SolveReport
  solve_condensed(const BlockSystem   &system,
                  const SolverOptions &options,
                  SystemSolution      &x);
} // namespace mortise
