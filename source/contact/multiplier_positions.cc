// See multiplier_positions.h.
#include <algorithm>
#include <cmath>

#include "point_trees.h"

namespace mortise
{
  using namespace dealii;

  unsigned int
  last_surface(const MultiplierPositions &positions, const MPI_Comm comm)
  {
    const auto last =
      std::max_element(positions.surfaces.begin(), positions.surfaces.end());
    return Utilities::MPI::max(last == positions.surfaces.end() ? 0u : *last,
                               comm);
  }

  ActivePositions::ActivePositions(const MultiplierPositions &positions,
                                   const std::vector<bool>   &active,
                                   const MPI_Comm             comm)
  {
    const unsigned int last = last_surface(positions, comm);
    for (unsigned int surface = 1; surface <= last; ++surface)
      by_surface.push_back(positions_of_all_ranks<2>(
        positions,
        surface,
        [&](const unsigned int i) { return active[i] ? 1 : 0; },
        comm));
  }

  bool
  ActivePositions::is_finite() const
  {
    for (const auto &of_surface : by_surface)
      for (const auto &positions : of_surface)
        for (const Position &position : positions)
          for (const double x : position)
            if (!std::isfinite(x))
              return false;
    return true;
  }

  std::vector<bool>
  ActivePositions::nearest(const MultiplierPositions &positions) const
  {
    constexpr double  rounding = 1e-6;
    std::vector<bool> result(positions.points.size(), true);
    for (unsigned int surface = 1; surface <= by_surface.size(); ++surface)
      {
        const auto     &of_surface = by_surface[surface - 1];
        const PointTree open(of_surface[0]), active(of_surface[1]);
        for (unsigned int i = 0; i < result.size(); ++i)
          if (positions.surfaces[i] == surface)
            result[i] = active.distance(positions.points[i]) <=
                        (1. + rounding) * open.distance(positions.points[i]);
      }
    return result;
  }
} // namespace mortise
