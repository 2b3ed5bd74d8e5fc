// See friction_history.h.
#include <mortise/contact/friction_history.h>

#include <cmath>
#include <map>

#include "point_trees.h"

namespace mortise
{
  using namespace dealii;

  FrictionHistory::FrictionHistory(const MultiplierPositions         &positions,
                                   const std::vector<FrictionRecord> &records,
                                   const MPI_Comm                     comm)
    : by_surface(last_surface(positions, comm))
  {
    auto own = by_surface;
    for (unsigned int i = 0; i < records.size(); ++i)
      own[positions.surfaces[i] - 1].push_back({{{positions.points[i][0],
                                                  positions.points[i][1],
                                                  positions.points[i][2]}},
                                                records[i]});
    for (const auto &of_rank : Utilities::MPI::all_gather(comm, own))
      for (unsigned int s = 0; s < by_surface.size(); ++s)
        by_surface[s].insert(by_surface[s].end(),
                             of_rank[s].begin(),
                             of_rank[s].end());
  }

  std::vector<FrictionRecord>
  FrictionHistory::nearest(const MultiplierPositions &positions) const
  {
    std::vector<FrictionRecord> result(positions.points.size());
    for (unsigned int s = 0; s < by_surface.size(); ++s)
      {
        std::vector<Position>              points;
        std::map<Position, FrictionRecord> records;
        for (const auto &[position, record] : by_surface[s])
          {
            points.push_back(position);
            records[position] = record;
          }
        const PointTree tree(points);
        for (unsigned int i = 0; i < result.size() && !tree.empty(); ++i)
          if (positions.surfaces[i] == s + 1)
            {
              const Point<3> at = tree.nearest(positions.points[i]);
              result[i]         = records.at({{at[0], at[1], at[2]}});
            }
      }
    return result;
  }

  bool
  FrictionHistory::is_finite() const
  {
    for (const auto &of_surface : by_surface)
      for (const auto &[position, record] : of_surface)
        {
          if (!std::isfinite(record.dissipated))
            return false;
          for (unsigned int c = 0; c < 3; ++c)
            if (!std::isfinite(position[c]) || !std::isfinite(record.slip[c]))
              return false;
        }
    return true;
  }
} // namespace mortise
