// Checks that loads and results are finite and representable, and the message
// of a solve that did not converge.
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

  /// Message of a solve with @p report that did not reach @p tolerance, with
  /// advice. @p n_sets: of contact, if active sets did not converge. @p advice:
  /// of SolverChoice.
  std::string
  not_converged(const SolveReport &report,
                double             tolerance,
                unsigned int       n_sets,
                const std::string &advice);
} // namespace mortise
