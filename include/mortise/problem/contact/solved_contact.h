// Contact of a solved load step, for results.
#pragma once

#include <deal.II/base/tensor.h>

#include <mortise/contact/friction.h>

#include <vector>

namespace mortise
{
  /// By owned node of contact; empty without contact.
  struct SolvedContact
  {
    std::vector<bool>       undecided; ///< pressure and gap zero to rounding?
    std::vector<NodeStatus> statuses;
    /// Since the beginning of the run, in the space of the multipliers.
    std::vector<dealii::Tensor<1, 3>> slips;
    std::vector<double>               dissipated; ///< energy, likewise
    /// By Coupling::number, that of nodes which are none any more.
    std::vector<double> dissipated_apart;
  };
} // namespace mortise
