// See slip_edge.h.
#include <mortise/contact/slip_edge.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "point_trees.h"

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// For tangential forces from a third to three quarters of full sliding
    /// the edge is right with 0.38 to 0.44.
    constexpr double borne_beside = 0.4;

    /// Of nodes at @p distances, each of which bears @p forces, the distance
    /// up to which they bear no more than @p force.
    double
    reach(std::vector<std::pair<double, double>> distances_and_forces,
          double                                 force)
    {
      constexpr double rounding = 1e-6;
      auto            &all      = distances_and_forces;
      std::sort(all.begin(), all.end());
      double result = -1.;
      for (auto next = all.begin(); next != all.end();)
        {
          // all that are equally near, or none
          const double distance = (1. + rounding) * next->first;
          for (; next != all.end() && next->first <= distance; ++next)
            force -= next->second;
          if (force < 0.)
            return result;
          result = distance;
        }
      return result;
    }
  } // namespace

  std::vector<Tensor<1, 3>>
  extend_slip(const NodePositions                &positions,
              const std::vector<TangentialForce> &forces,
              const MPI_Comm                      comm)
  {
    using Position = std::array<double, 3>;
    std::vector<Tensor<1, 3>> result(forces.size());
    const unsigned int        last = last_surface(positions, comm);
    for (unsigned int surface = 1; surface <= last; ++surface)
      {
        const auto for_each = [&](const TangentialForce::Kind kind,
                                  const auto                 &visit) {
          for (unsigned int i = 0; i < forces.size(); ++i)
            if (positions.surfaces[i] == surface && forces[i].kind == kind)
              visit(i, positions.points[i], forces[i]);
        };
        double                                     excess = 0.;
        std::vector<std::pair<Position, Position>> own;
        for_each(TangentialForce::begins,
                 [&](const unsigned int, const auto &at, const auto &of_node) {
                   const double size = of_node.force.norm();
                   excess += size - of_node.bound;
                   own.emplace_back(coordinates(at),
                                    coordinates(
                                      Point<3>(of_node.force / size)));
                 });
        std::vector<Position>        points;
        std::map<Position, Position> directions;
        for (const auto &of_rank : Utilities::MPI::all_gather(comm, own))
          for (const auto &[point, direction] : of_rank)
            {
              points.push_back(point);
              directions[point] = direction;
            }
        if (points.empty())
          continue;
        const PointTree                        begin(points);
        std::vector<std::pair<double, double>> others, all;
        for_each(
          TangentialForce::may_slip,
          [&](const unsigned int i, const auto &at, const auto &of_node) {
            const Point<3> nearest   = begin.nearest(at);
            const auto    &direction = directions.at(coordinates(nearest));
            for (unsigned int c = 0; c < 3; ++c)
              result[i][c] = direction[c];
            others.emplace_back(nearest.distance(at),
                                of_node.bound - of_node.force * result[i]);
          });
        for (const auto &of_rank : Utilities::MPI::all_gather(comm, others))
          all.insert(all.end(), of_rank.begin(), of_rank.end());
        const double up_to =
          reach(std::move(all),
                borne_beside * Utilities::MPI::sum(excess, comm));
        auto next = others.begin();
        for_each(TangentialForce::may_slip,
                 [&](const unsigned int i, const auto &, const auto &) {
                   if ((next++)->first > up_to)
                     result[i] = 0.;
                 });
      }
    return result;
  }
} // namespace mortise
