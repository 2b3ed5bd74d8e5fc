// See multiplier_places.h.
#include <algorithm>

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

  /// By surface, of those that are not active and of those that are.
  struct ActivePlaces::Trees
  {
    std::vector<std::vector<PlaceTree>> by_surface;
  };

  ActivePlaces::ActivePlaces(const MultiplierPlaces  &places,
                             const std::vector<bool> &active,
                             const MPI_Comm           comm)
  {
    auto               all  = std::make_shared<Trees>();
    const unsigned int last = last_surface(places, comm);
    for (unsigned int surface = 1; surface <= last; ++surface)
      all->by_surface.push_back(place_trees<2>(
        places,
        surface,
        [&](const unsigned int i) { return active[i] ? 1 : 0; },
        comm));
    trees = std::move(all);
  }

  std::vector<bool>
  ActivePlaces::nearest(const MultiplierPlaces &places) const
  {
    constexpr double  rounding = 1e-6;
    std::vector<bool> result(places.points.size(), true);
    for (unsigned int i = 0; i < result.size(); ++i)
      if (const unsigned int surface = places.surfaces[i];
          surface > 0 && surface <= trees->by_surface.size())
        {
          const auto &of_surface = trees->by_surface[surface - 1];
          result[i] =
            of_surface[1].distance(places.points[i]) <=
            (1. + rounding) * of_surface[0].distance(places.points[i]);
        }
    return result;
  }
} // namespace mortise
