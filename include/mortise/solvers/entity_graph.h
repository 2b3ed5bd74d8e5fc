// Which mesh entities of a rank couple with which others in A = K + J, found in the graph of the
// matrices: interiors of cells, and the patches around vertices. It never looks at values.
#pragma once

#include <mortise/operators/block_system.h>

#include <vector>

namespace mortise
{
  /// Entities are the blocks of BlockSystem::entity_blocks, numbered as there on their own rank.
  class EntityGraph
  {
  public:
    /// Collective.
    explicit EntityGraph(const BlockSystem &system);

    /// Whether the block belongs to one cell only, so that eliminating it fills in nothing: all its
    /// neighbours are neighbours of each other. No two interiors are neighbours.
    bool
    is_interior(const unsigned int block) const
    {
      return interior[block];
    }

    /// Overlapping groups of blocks that are not interior; together they hold all of them. A patch is the
    /// star of a vertex v (every entity o with N(o) within N(v), N being the neighbours in A); on an
    /// interface with the entities of the other side that J couples with that star alone.
    std::vector<std::vector<unsigned int>>
    patches() const;

  private:
    using Lists = std::vector<std::vector<int>>;

    void
    connect(const BlockSystem &system);
    void
    find_interiors(const BlockSystem &system);
    bool
    is_owned(const int block) const
    {
      return block >= first_block && block < first_block + static_cast<int>(neighbors.size());
    }

    int               first_block = 0; ///< blocks of all ranks are numbered rank by rank
    std::vector<int>  block_of_dof;    ///< owned dofs, by position
    Lists             neighbors;       ///< in A, sorted, itself included
    Lists             jump_neighbors;  ///< in J
    std::vector<bool> vertex, interior;
  };
} // namespace mortise
