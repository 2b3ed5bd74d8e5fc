// Are the loads of a scene, and then its results, numbers that a run can stand
// for?
#pragma once

#include <mortise/operators/block_system.h>
#include <mortise/output/summary.h>
#include <mortise/solvers/solve_report.h>

#include <string>

namespace mortise
{
  /// Throw InputError if the largest entry of @p rhs is neither 0 nor between smallest_number and
  /// largest_number: its square could not be represented, and a residual
  /// relative to it would be 0/0. Collective.
  void
  check_loads(const SystemVector &rhs);

  /// The first result of @p step that is not finite, as "name = value"; empty if
  /// all are.
  std::string
  first_not_finite(const StepSummary &step);

  /// What a solve that ended with @p report lacks of @p tolerance, and what to do about it. @p n_sets:
  /// of contact, where these did not come to an end. @p advice: of SolverChoice.
  std::string
  not_converged(const SolveReport &report,
                double             tolerance,
                unsigned int       n_sets,
                const std::string &advice);
} // namespace mortise
