// Coarser lattices of the blocks that generators make meshes of: which vertices
// go, and what a function of degree one on the coarser lattice is there. It
// knows no ranks and no triangulation.
#pragma once

#include <deal.II/base/point.h>

#include <array>
#include <utility>
#include <vector>

namespace mortise
{
  /// n[0] x n[1] x n[2] cells.
  struct LatticeBlock
  {
    std::array<unsigned int, 3> n;
    /// Of the coarse mesh, by lattice point, the first direction fastest.
    std::vector<unsigned int> vertices;

    unsigned int
    vertex(const std::array<unsigned int, 3> &point) const
    {
      return vertices[point[0] +
                      (n[0] + 1) * (point[1] + (n[1] + 1) * point[2])];
    }
  };

  /// Each step keeps every other plane of the directions with the smallest
  /// distances of planes, and the last one.
  class LatticeCoarsening
  {
  public:
    using Entries = std::vector<std::pair<unsigned int, double>>;

    /// @p blocks: kept by reference; where they meet, planes and numbers of
    /// cells do, too. @p points: of the vertices.
    LatticeCoarsening(const std::vector<LatticeBlock>     &blocks,
                      const std::vector<dealii::Point<3>> &points);

    unsigned int
    n_steps() const
    {
      return steps.size() - 1;
    }

    /// Calls @p visit(vertex, entries) for the vertices that go in step @p
    /// step, those between blocks several times: the value there is the sum of
    /// weights times the values at other vertices, which stay.
    template <typename Visit>
    void
    for_each(const unsigned int step, const Visit &visit) const
    {
      Entries entries;
      for (unsigned int b = 0; b < blocks.size(); ++b)
        for (const unsigned int i : steps[step][b][0])
          for (const unsigned int j : steps[step][b][1])
            for (const unsigned int k : steps[step][b][2])
              if (find_entries(step, b, {{i, j, k}}, entries))
                visit(blocks[b].vertex({{i, j, k}}), entries);
    }

  private:
    using Planes = std::array<std::vector<unsigned int>, 3>;

    /// False where the vertex stays.
    bool
    find_entries(unsigned int                       step,
                 unsigned int                       block,
                 const std::array<unsigned int, 3> &point,
                 Entries                           &entries) const;

    const std::vector<LatticeBlock> &blocks;
    std::vector<std::vector<Planes>> steps; ///< by step and block: what is left
  };
} // namespace mortise
