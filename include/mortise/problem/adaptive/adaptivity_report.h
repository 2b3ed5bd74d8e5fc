// What a run with a target tells of its error: numbers for the summary, words
// for the log.
#pragma once

#include <mortise/output/summary.h>
#include <mortise/problem/adaptive/adaptivity.h>

#include <optional>
#include <string>

namespace mortise
{
  /// The last cycle; @p exact may be null, @p errors are those of the whole solution. Collective.
  AdaptivitySummary
  summary_of(const Adaptivity                  &adaptivity,
             const Bodies                      &bodies,
             const ExactSolution               *exact,
             const std::optional<ErrorSummary> &errors);

  /// Estimate and target, in words.
  std::string
  found(const Adaptivity &adaptivity, const Bodies &bodies);

  /// That the target is not reached, why, and what was.
  std::string
  missed(const Adaptivity &adaptivity);
} // namespace mortise
