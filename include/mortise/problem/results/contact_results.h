// Results of contact in a load step.
#pragma once

#include <mortise/output/summary.h>
#include <mortise/problem/results/step_evaluation.h>

#include <vector>

namespace mortise
{
  /// Add the results of contact to the interfaces of @p summary. Throws
  /// InputError if a face without a partner could have come into contact.
  /// Collective.
  void
  add_contact(const StepEvaluation &step, StepSummary &summary);

  /// By slave face of interface @p i: coefficients of pressure, gap (a length)
  /// and status (1: active, 0: inactive), one after the other; empty without
  /// contact. Collective.
  std::vector<std::vector<double>>
  contact_fields(const StepEvaluation &step, unsigned int i);
} // namespace mortise
