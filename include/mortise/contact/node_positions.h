// Positions of the nodes of contact.
#pragma once

#include <deal.II/base/point.h>

#include <vector>

namespace mortise
{
  /// By owned node of contact.
  struct NodePositions
  {
    std::vector<dealii::Point<3>> points;
    /// Number of the surface of each, from 1 on.
    std::vector<unsigned int> surfaces;
  };
} // namespace mortise
