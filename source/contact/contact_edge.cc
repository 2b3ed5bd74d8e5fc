// See contact_edge.h.
#include <deal.II/numerics/rtree.h>

#include <mortise/contact/contact_edge.h>

#include <algorithm>
#include <array>
#include <utility>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Multipliers of one kind on one surface, of all ranks.
    class Places
    {
    public:
      explicit Places(const std::vector<Point<3>> &points)
        : tree(pack_rtree(points))
      {}

      bool
      empty() const
      {
        return tree.empty();
      }

      Point<3>
      nearest(const Point<3> &to) const
      {
        Point<3> result;
        tree.query(boost::geometry::index::nearest(to, 1), &result);
        return result;
      }

      double
      distance(const Point<3> &from) const
      {
        return nearest(from).distance(from);
      }

    private:
      RTree<Point<3>> tree;
    };
  } // namespace

  ContactEdge::ContactEdge(std::vector<Point<3>>     places,
                           std::vector<unsigned int> surfaces,
                           const MPI_Comm            comm)
    : places(std::move(places))
    , surfaces(std::move(surfaces))
    , n_surfaces(Utilities::MPI::max(
        this->surfaces.empty() ?
          0u :
          1 + *std::max_element(this->surfaces.begin(), this->surfaces.end()),
        comm))
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
    for (unsigned int surface = 0; surface < n_surfaces; ++surface)
      {
        std::array<std::vector<Point<3>>, n_kinds> own;
        for (unsigned int i = 0; i < places.size(); ++i)
          if (surfaces[i] == surface)
            own[kind(i)].push_back(places[i]);
        std::array<std::vector<Point<3>>, n_kinds> all;
        for (const auto &of_rank : Utilities::MPI::all_gather(comm, own))
          for (unsigned int k = 0; k < n_kinds; ++k)
            all[k].insert(all[k].end(), of_rank[k].begin(), of_rank[k].end());
        if (std::any_of(all.begin(), all.end(), [](const auto &points) {
              return points.empty();
            }))
          continue;
        const Places opened(all[open]), pulled(all[pulling]),
          pressed(all[pressing]);
        for (unsigned int i = 0; i < places.size(); ++i)
          if (surfaces[i] == surface && kind(i) == pressing)
            {
              constexpr double rounding = 1e-6;
              const Point<3>   inner    = pulled.nearest(places[i]),
                             edge       = opened.nearest(inner);
              // the edge is between what pulls and what is open; where the
              // nearest that pulls is deep inside, it is another's
              const double depth = inner.distance(edge),
                           outer = pulled.distance(edge);
              more[i]            = outer < (0.5 + rounding) * depth &&
                        places[i].distance(inner) <
                          (1. - rounding) * (depth - outer / 2.);
            }
      }
    turns = std::move(more);
  }
} // namespace mortise
