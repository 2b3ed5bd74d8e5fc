// See contact_edge.h.
#include <mortise/contact/contact_edge.h>

#include <algorithm>
#include <utility>

#include "place_trees.h"

namespace mortise
{
  using namespace dealii;

  ContactEdge::ContactEdge(MultiplierPlaces places, const MPI_Comm comm)
    : places(std::move(places))
    , n_surfaces(last_surface(this->places, comm))
    , comm(comm)
  {}

  void
  ContactEdge::extend(const std::vector<bool> &active,
                      std::vector<bool>       &turns) const
  {
    enum
    {
      open,
      pulling,
      pressing,
      n_kinds
    };
    const auto kind = [&](const unsigned int i) {
      return !active[i] ? open : turns[i] ? pulling : pressing;
    };
    std::vector<bool> more = turns;
    for (unsigned int surface = 1; surface <= n_surfaces; ++surface)
      {
        const auto by_kind =
          places_of_all_ranks<n_kinds>(places, surface, kind, comm);
        const std::vector<PlaceTree> all(by_kind.begin(), by_kind.end());
        if (std::any_of(all.begin(), all.end(), [](const PlaceTree &tree) {
              return tree.empty();
            }))
          continue;
        const PlaceTree &pulled = all[pulling];
        for (unsigned int i = 0; i < places.points.size(); ++i)
          if (places.surfaces[i] == surface && kind(i) == pressing)
            {
              constexpr double rounding = 1e-6;
              const Point<3>  &place    = places.points[i];
              const Point<3>   inner    = pulled.nearest(place),
                             edge       = all[open].nearest(inner);
              // the edge is between what pulls and what is open; where the
              // nearest that pulls is deep inside, it is another's
              const double depth = inner.distance(edge),
                           outer = pulled.distance(edge);
              more[i] =
                outer < (0.5 + rounding) * depth &&
                place.distance(inner) < (1. - rounding) * (depth - outer / 2.);
            }
      }
    turns = std::move(more);
  }
} // namespace mortise
