// See lattice_coarsening.h.
#include <mortise/body/mesh/lattice_coarsening.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Directions with distances of planes up to this many times the smallest
    /// one are coarsened together.
    constexpr double largest_ratio = 2.;

    /// The mean length of edges by direction, over all blocks; equal ones
    /// exactly so.
    std::array<double, 3>
    edge_lengths(const std::vector<LatticeBlock> &blocks,
                 const std::vector<Point<3>>     &points)
    {
      std::array<double, 3> sums{}, n_edges{};
      for (const LatticeBlock &block : blocks)
        for (unsigned int d = 0; d < 3; ++d)
          {
            std::array<unsigned int, 3> end = block.n;
            --end[d];
            for (unsigned int i = 0; i <= end[0]; ++i)
              for (unsigned int j = 0; j <= end[1]; ++j)
                for (unsigned int k = 0; k <= end[2]; ++k)
                  {
                    std::array<unsigned int, 3> from{{i, j, k}}, to = from;
                    ++to[d];
                    sums[d] += points[block.vertex(from)].distance(
                      points[block.vertex(to)]);
                    ++n_edges[d];
                  }
          }
      for (unsigned int d = 0; d < 3; ++d)
        {
          sums[d] /= n_edges[d];
          for (unsigned int e = 0; e < d; ++e)
            if (std::abs(sums[d] - sums[e]) < 1e-6 * sums[e])
              sums[d] = sums[e];
        }
      return sums;
    }
  } // namespace

  LatticeCoarsening::LatticeCoarsening(const std::vector<LatticeBlock> &blocks,
                                       const std::vector<Point<3>>     &points)
    : blocks(blocks)
    , steps(1)
  {
    if (blocks.empty())
      return;
    for (const LatticeBlock &block : blocks)
      {
        steps[0].emplace_back();
        for (unsigned int d = 0; d < 3; ++d)
          {
            steps[0].back()[d].resize(block.n[d] + 1);
            std::iota(steps[0].back()[d].begin(), steps[0].back()[d].end(), 0);
          }
      }
    auto       length   = edge_lengths(blocks, points);
    const auto can_fall = [&](const unsigned int d) {
      return std::any_of(steps.back().begin(),
                         steps.back().end(),
                         [&](const Planes &planes) {
                           return planes[d].size() > 2;
                         });
    };
    while (can_fall(0) || can_fall(1) || can_fall(2))
      {
        double smallest = std::numeric_limits<double>::max();
        for (unsigned int d = 0; d < 3; ++d)
          if (can_fall(d))
            smallest = std::min(smallest, length[d]);
        auto coarser = steps.back();
        for (unsigned int d = 0; d < 3; ++d)
          if (can_fall(d) && length[d] <= largest_ratio * smallest)
            {
              length[d] *= 2.;
              for (Planes &planes : coarser)
                {
                  std::vector<unsigned int> kept;
                  for (unsigned int i = 0; i < planes[d].size(); ++i)
                    if (i % 2 == 0 || i + 1 == planes[d].size())
                      kept.push_back(planes[d][i]);
                  planes[d] = std::move(kept);
                }
            }
        steps.push_back(std::move(coarser));
      }
  }

  bool
  LatticeCoarsening::find_entries(const unsigned int                 step,
                                  const unsigned int                 block,
                                  const std::array<unsigned int, 3> &point,
                                  Entries &entries) const
  {
    using Line = std::vector<std::pair<unsigned int, double>>;
    std::array<Line, 3> lines;
    bool                goes = false;
    for (unsigned int d = 0; d < 3; ++d)
      {
        const auto &kept = steps[step + 1][block][d];
        const auto above = std::lower_bound(kept.begin(), kept.end(), point[d]);
        if (*above == point[d])
          lines[d] = {{point[d], 1.}};
        else
          {
            const unsigned int to = *above, from = *(above - 1);
            const double       t = double(point[d] - from) / (to - from);
            lines[d]             = {{from, 1. - t}, {to, t}};
            goes                 = true;
          }
      }
    if (!goes)
      return false;
    entries.clear();
    for (const auto &[i, u] : lines[0])
      for (const auto &[j, v] : lines[1])
        for (const auto &[k, w] : lines[2])
          entries.emplace_back(blocks[block].vertex({{i, j, k}}), u * v * w);
    return true;
  }
} // namespace mortise
