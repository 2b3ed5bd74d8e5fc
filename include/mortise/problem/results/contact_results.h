// What a step with contact has computed, as users see it.
#pragma once

#include <mortise/output/summary.h>
#include <mortise/problem/results/step_evaluation.h>

#include <vector>

namespace mortise
{
  /// Add to the interfaces of @p summary what is in contact. Throws InputError where a face
  /// without a partner could have met one. Collective.
  void
  add_contact(const StepEvaluation &step, StepSummary &summary);

  /// By slave face of interface @p i: coefficients of the pressure, of the gap (a
  /// length) and of the status (1 where it presses, 0 where it does not), one
  /// after the other; nothing without contact. Collective.
  std::vector<std::vector<double>>
  contact_fields(const StepEvaluation &step, unsigned int i);
} // namespace mortise
