// Where a run stands: what a step begins with and returns.
#pragma once

#include <mortise/contact/multiplier_places.h>
#include <mortise/operators/block_system.h>

#include <optional>
#include <vector>

namespace mortise
{
  /// Of the last step that was accepted.
  struct State
  {
    double       time = 0.;
    SystemVector solution; ///< without what is prescribed; no size: unloaded
    /// Which multipliers of contact press; absent where none have been
    /// determined.
    std::optional<ActivePlaces> pressing;
    /// By interface, how far a preload brings its sides together, a length;
    /// empty before the first step.
    std::vector<double> shortenings;
  };
} // namespace mortise
