// A step that was solved: what acts, and the unknowns.
#pragma once

#include <mortise/operators/block_system.h>
#include <mortise/operators/scene_load.h>
#include <mortise/problem/scene/scene_data.h>

#include <vector>

namespace mortise
{
  struct SolvedStep
  {
    const SceneData    &data;
    const SceneLoad    &load;
    const SystemVector &solution;
    /// By owned multiplier: pressure and gap are zero but for rounding; empty
    /// in a scene without contact.
    const std::vector<bool> undecided;
    /// By interface, what its preload adds to its offset, a length.
    const std::vector<double> shortenings;
  };

  /// As the summary has vectors.
  inline std::vector<double>
  components(const dealii::Tensor<1, dim> &value)
  {
    return {value[0], value[1], value[2]};
  }
} // namespace mortise
