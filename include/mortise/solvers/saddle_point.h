// GMRES on the indefinite system of displacements, pressures and multipliers
// with a block factorisation as preconditioner. It never needs K to be regular.
#pragma once

#include <mortise/operators/block_system.h>
#include <mortise/solvers/solve_report.h>
#include <mortise/solvers/solver_options.h>

namespace mortise
{
  /// Solve by preconditioned GMRES; the preconditioner takes a
  /// BulkPreconditioner, the Schur complement of its Lifting for the
  /// multipliers and a PressurePreconditioner. See solve().
  SolveReport
  solve_saddle_point(const BlockSystem   &system,
                     const SolverOptions &options,
                     SystemSolution      &x);
} // namespace mortise
