// Trees of nodes of contact.
#pragma once

#include <deal.II/base/mpi.h>

#include <deal.II/numerics/rtree.h>

#include <mortise/contact/node_positions.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace mortise
{
  inline std::array<double, 3>
  coordinates(const dealii::Point<3> &point)
  {
    return {{point[0], point[1], point[2]}};
  }

  class PointTree
  {
  public:
    explicit PointTree(const std::vector<std::array<double, 3>> &positions)
    {
      std::vector<dealii::Point<3>> points;
      for (const auto &[x, y, z] : positions)
        points.emplace_back(x, y, z);
      tree = dealii::pack_rtree(points);
    }

    bool
    empty() const
    {
      return tree.empty();
    }

    /// Of those that there are, at least one.
    dealii::Point<3>
    nearest(const dealii::Point<3> &to) const
    {
      dealii::Point<3> result;
      tree.query(boost::geometry::index::nearest(to, 1), &result);
      return result;
    }

    /// To the nearest; infinite where there is none.
    double
    distance(const dealii::Point<3> &from) const
    {
      return empty() ? std::numeric_limits<double>::infinity() :
                       nearest(from).distance(from);
    }

  private:
    dealii::RTree<dealii::Point<3>> tree;
  };

  /// Places on one surface, of all ranks, by @p kind(i) < n_kinds. Collective.
  template <std::size_t n_kinds, typename Kind>
  std::array<std::vector<std::array<double, 3>>, n_kinds>
  positions_of_all_ranks(const NodePositions &positions,
                         const unsigned int   surface,
                         const Kind          &kind,
                         const MPI_Comm       comm)
  {
    std::array<std::vector<std::array<double, 3>>, n_kinds> own, all;
    for (unsigned int i = 0; i < positions.points.size(); ++i)
      if (positions.surfaces[i] == surface)
        own[kind(i)].push_back(coordinates(positions.points[i]));
    for (const auto &of_rank : dealii::Utilities::MPI::all_gather(comm, own))
      for (unsigned int k = 0; k < n_kinds; ++k)
        all[k].insert(all[k].end(), of_rank[k].begin(), of_rank[k].end());
    return all;
  }

  /// The largest of the numbers of surfaces. Collective.
  inline unsigned int
  last_surface(const NodePositions &positions, const MPI_Comm comm)
  {
    const auto last =
      std::max_element(positions.surfaces.begin(), positions.surfaces.end());
    return dealii::Utilities::MPI::max(last == positions.surfaces.end() ? 0u :
                                                                          *last,
                                       comm);
  }
} // namespace mortise
