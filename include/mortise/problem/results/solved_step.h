// A solved load step: loads and unknowns.
#pragma once

#include <mortise/operators/block_system.h>
#include <mortise/operators/scene_load.h>
#include <mortise/problem/contact/solved_contact.h>
#include <mortise/problem/scene/scene_data.h>

#include <vector>

namespace mortise
{
  struct SolvedStep
  {
    const SceneData    &data;
    const SceneLoad    &load;
    const SystemVector &solution;
    const PointHistory &history; ///< see State
    const SolvedContact contact;
    /// See State.
    const std::vector<double> shortenings;
  };

  /// The components of a vector for the summary.
  inline std::vector<double>
  components(const dealii::Tensor<1, dim> &value)
  {
    return {value[0], value[1], value[2]};
  }
} // namespace mortise
