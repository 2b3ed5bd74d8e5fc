// State of a run, argument and result of a load step.
#pragma once

#include <mortise/contact/contact_records.h>
#include <mortise/operators/block_system.h>

#include <optional>
#include <vector>

namespace mortise
{
  /// How a path goes on, see ArcLength.
  struct PathState
  {
    /// Of the displacement in the last step, zero at constrained components;
    /// empty before.
    Vector increment;
    double tangent = 0.; ///< size of the first one; 0 before
  };

  /// After the last accepted step.
  struct State
  {
    double       time = 0.;
    SystemVector solution; ///< without prescribed values; empty: unloaded
    /// In scenes with laws that are not linear: the displacement at nodes with
    /// prescribed values, zero where nodes hang, and what points remember.
    Vector       displacement;
    PointHistory history;
    PathState    path; ///< with arc-length control
    /// Absent before it is known; before the first step a guess.
    std::optional<ContactRecords> contact;
    /// By interface, the shortening of its preload, a length; then the mean
    /// strain of a periodic cell. Empty before the first step.
    std::vector<double> shortenings;
    /// The motions of rigid parts, one after the other; empty before the first
    /// step.
    std::vector<double> motions;
  };
} // namespace mortise
