// See multiplier_places.h.
#include <algorithm>
#include <cmath>

#include "place_trees.h"

namespace mortise
{
  using namespace dealii;

  unsigned int
  last_surface(const MultiplierPlaces &places, const MPI_Comm comm)
  {
    const auto last =
      std::max_element(places.surfaces.begin(), places.surfaces.end());
    return Utilities::MPI::max(last == places.surfaces.end() ? 0u : *last,
                               comm);
  }

  ActivePlaces::ActivePlaces(const MultiplierPlaces  &places,
                             const std::vector<bool> &active,
                             const MPI_Comm           comm)
  {
    const unsigned int last = last_surface(places, comm);
    for (unsigned int surface = 1; surface <= last; ++surface)
      by_surface.push_back(places_of_all_ranks<2>(
        places,
        surface,
        [&](const unsigned int i) { return active[i] ? 1 : 0; },
        comm));
  }

  bool
  ActivePlaces::is_finite() const
  {
    for (const auto &of_surface : by_surface)
      for (const auto &places : of_surface)
        for (const Place &place : places)
          for (const double x : place)
            if (!std::isfinite(x))
              return false;
    return true;
  }

  std::vector<bool>
  ActivePlaces::nearest(const MultiplierPlaces &places) const
  {
    constexpr double  rounding = 1e-6;
    std::vector<bool> result(places.points.size(), true);
    for (unsigned int surface = 1; surface <= by_surface.size(); ++surface)
      {
        const auto     &of_surface = by_surface[surface - 1];
        const PlaceTree open(of_surface[0]), pressing(of_surface[1]);
        for (unsigned int i = 0; i < result.size(); ++i)
          if (places.surfaces[i] == surface)
            result[i] = pressing.distance(places.points[i]) <=
                        (1. + rounding) * open.distance(places.points[i]);
      }
    return result;
  }
} // namespace mortise
