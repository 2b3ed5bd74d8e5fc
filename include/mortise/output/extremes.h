// The largest displacement and the largest von Mises stress of a body, each
// with its place.
#pragma once

#include <mortise/body/body.h>
#include <mortise/operators/scene_solution.h>
#include <mortise/output/summary.h>

namespace mortise
{
  struct Extremes
  {
    PeakSummary                displacement;   ///< a length
    StressPeakSummary          von_mises;      ///< force per area
    std::optional<PeakSummary> plastic_strain; ///< of laws that have one
  };

  /// Of @p solution at the nodes of the cells of @p body, corners among them: Gauss-Lobatto points of
  /// hexahedra, evenly spaced ones of tetrahedra, as many as a cell's degree
  /// has. Of places that have the largest value to within a millionth it is the
  /// same one on any number of ranks. Collective.
  Extremes
  extremes(const Body &body, const BodySolution &solution);
} // namespace mortise
