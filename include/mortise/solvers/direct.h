// Direct solution of the monolithic saddle-point system [K G^T B^T; G -C 0; B 0
// 0] with iterative refinement: small scenes and reference. It never
// approximates and never looks at the preconditioner's data except for scaling.
#pragma once

#include <mortise/operators/block_system.h>
#include <mortise/solvers/solve_report.h>
#include <mortise/solvers/solver_options.h>

namespace mortise
{
  /// Solve by a sparse factorisation. Works on any number of ranks, those
  /// without dofs included. See solve() for the arguments.
  SolveReport
  solve_direct(const BlockSystem   &system,
               const SolverOptions &options,
               SystemSolution      &x);
} // namespace mortise
