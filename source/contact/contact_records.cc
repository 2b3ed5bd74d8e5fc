// See contact_records.h.
#include <mortise/contact/contact_records.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "point_trees.h"

namespace mortise
{
  using namespace dealii;

  ContactRecords::ContactRecords(const NodePositions              &positions,
                                 const std::vector<ContactRecord> &records,
                                 std::vector<double> dissipated_apart,
                                 const MPI_Comm      comm)
    : by_surface(last_surface(positions, comm))
    , dissipated_apart(std::move(dissipated_apart))
  {
    auto own = by_surface;
    for (unsigned int i = 0; i < records.size(); ++i)
      own[positions.surfaces[i] - 1].emplace_back(
        coordinates(positions.points[i]), records[i]);
    for (const auto &of_rank : Utilities::MPI::all_gather(comm, own))
      for (unsigned int s = 0; s < by_surface.size(); ++s)
        by_surface[s].insert(by_surface[s].end(),
                             of_rank[s].begin(),
                             of_rank[s].end());
  }

  std::vector<double>
  ContactRecords::dissipated() const
  {
    std::vector<double> result = dissipated_apart;
    result.resize(std::max(result.size(), by_surface.size()), 0.);
    for (unsigned int s = 0; s < by_surface.size(); ++s)
      for (const auto &[position, record] : by_surface[s])
        result[s] += record.dissipated;
    return result;
  }

  std::vector<ContactRecord>
  ContactRecords::nearest(const NodePositions &positions) const
  {
    constexpr double           rounding = 1e-6;
    std::vector<ContactRecord> result(positions.points.size());
    for (ContactRecord &record : result)
      record.closed = true;
    for (unsigned int s = 0; s < by_surface.size(); ++s)
      {
        std::array<std::vector<Position>, 2>      points; // open, closed
        std::map<Position, const ContactRecord *> records;
        for (const auto &[position, record] : by_surface[s])
          {
            points[record.closed].push_back(position);
            records[position] = &record;
          }
        const PointTree open(points[0]), closed(points[1]);
        for (unsigned int i = 0; i < result.size() && !records.empty(); ++i)
          if (const Point<3> &at = positions.points[i];
              positions.surfaces[i] == s + 1)
            {
              const bool is_closed =
                closed.distance(at) <= (1. + rounding) * open.distance(at);
              result[i] = *records.at(
                coordinates((is_closed ? closed : open).nearest(at)));
            }
      }
    return result;
  }

  bool
  ContactRecords::is_finite() const
  {
    for (const auto &of_surface : by_surface)
      for (const auto &[position, record] : of_surface)
        if (!std::isfinite(position[0] + position[1] + position[2]) ||
            !std::isfinite(record.traction.norm() + record.increment.norm() +
                           record.slip.norm() + record.dissipated))
          return false;
    return true;
  }
} // namespace mortise
