// What a step with contact has computed, as users see it.
#pragma once

#include <mortise/problem/results/step_results.h>

#include <vector>

namespace mortise
{
  /// Add to the interfaces of @p summary what is in contact. Throws InputError where a face
  /// without a partner could have met one. Collective.
  void
  add_contact(const RunContext     &run,
              const Discretisation &discretisation,
              const SolvedStep     &solved,
              const StepFields     &fields,
              StepSummary          &summary);

  /// By interface and slave face: coefficients of the pressure, of the gap (a
  /// length) and of the status (1 where it presses, 0 where it does not), one
  /// after the other; nothing of interfaces without contact. Collective.
  std::vector<std::vector<std::vector<double>>>
  contact_fields(const RunContext     &run,
                 const Discretisation &discretisation,
                 const SolvedStep     &solved);
} // namespace mortise
