// State of a run, argument and result of a load step.
#pragma once

#include <mortise/contact/friction_history.h>
#include <mortise/contact/multiplier_positions.h>
#include <mortise/operators/block_system.h>

#include <optional>
#include <vector>

namespace mortise
{
  /// After the last accepted step.
  struct State
  {
    double       time = 0.;
    SystemVector solution; ///< without prescribed values; empty: unloaded
    /// Active set of contact; absent before it is known.
    std::optional<ActivePositions> active_set;
    /// Absent without friction, and before the first step.
    std::optional<FrictionHistory> friction;
    /// By interface, the shortening of its preload, a length; empty before the
    /// first step.
    std::vector<double> shortenings;
  };
} // namespace mortise
