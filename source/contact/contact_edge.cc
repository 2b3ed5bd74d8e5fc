// See contact_edge.h.
#include <mortise/contact/contact_edge.h>

#include <algorithm>
#include <utility>

#include "point_trees.h"

namespace mortise
{
  using namespace dealii;

  ContactEdge::ContactEdge(NodePositions positions, const MPI_Comm comm)
    : positions(std::move(positions))
    , n_surfaces(last_surface(this->positions, comm))
    , comm(comm)
  {}

  void
  ContactEdge::extend(const std::vector<bool> &active,
                      std::vector<bool>       &turns) const
  {
    enum
    {
      open,
      tensile,
      compressive,
      n_kinds
    };
    const auto kind = [&](const unsigned int i) {
      return !active[i] ? open : turns[i] ? tensile : compressive;
    };
    std::vector<bool> more = turns;
    for (unsigned int surface = 1; surface <= n_surfaces; ++surface)
      {
        const auto by_kind =
          positions_of_all_ranks<n_kinds>(positions, surface, kind, comm);
        const std::vector<PointTree> all(by_kind.begin(), by_kind.end());
        if (std::any_of(all.begin(), all.end(), [](const PointTree &tree) {
              return tree.empty();
            }))
          continue;
        const PointTree &tensile_points = all[tensile];
        for (unsigned int i = 0; i < positions.points.size(); ++i)
          if (positions.surfaces[i] == surface && kind(i) == compressive)
            {
              constexpr double rounding = 1e-6;
              const Point<3>  &position = positions.points[i];
              const Point<3>   inner    = tensile_points.nearest(position),
                             edge       = all[open].nearest(inner);
              // the edge is between tensile and open ones; where the
              // nearest tensile one is deep inside, it is another's
              const double depth = inner.distance(edge),
                           outer = tensile_points.distance(edge);
              more[i]            = outer < (0.5 + rounding) * depth &&
                        position.distance(inner) <
                          (1. - rounding) * (depth - outer / 2.);
            }
      }
    turns = std::move(more);
  }
} // namespace mortise
