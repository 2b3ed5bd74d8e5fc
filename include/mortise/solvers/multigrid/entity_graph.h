// Which mesh entities of a rank couple with which others in A = K + J, found in
// the graph of the matrices: the patches around vertices.
#pragma once

#include <mortise/operators/block_system.h>

#include <map>
#include <vector>

namespace mortise
{
  /// Entities are the blocks of BlockSystem::entity_blocks, numbered as there
  /// on their own rank.
  class EntityGraph
  {
  public:
    /// Collective.
    explicit EntityGraph(const BlockSystem &system);

    /// Overlapping groups of dofs, those of other ranks included; the groups of
    /// all ranks together hold all dofs that are in a block. A group is the
    /// star of an owned vertex v (every entity o with N(o) within N(v), N being
    /// the neighbours in A); on an interface with the entities of the other
    /// side that J couples with that star alone.
    std::vector<std::vector<dealii::types::global_dof_index>>
    patches(const BlockSystem &system) const;

  private:
    using Lists = std::vector<std::vector<int>>;

    /// A block of another rank.
    struct Ghost
    {
      std::vector<dealii::types::global_dof_index> dofs;
      std::vector<int>                             neighbors, jump_neighbors;

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &dofs &neighbors &jump_neighbors;
      }
    };

    void
    connect(const BlockSystem &system);
    void
    fetch_ghosts(const BlockSystem &system);
    bool
    is_owned(const int block) const
    {
      return block >= first_block &&
             block < first_block + static_cast<int>(neighbors.size());
    }

    std::vector<int> rank_start; ///< first block of each rank, and their number
    std::map<int, Ghost> ghosts; ///< neighbours of owned vertices
    int first_block = 0; ///< blocks of all ranks are numbered rank by rank
    std::vector<int>
          block_of_dof;   ///< owned dofs, by position; -1: interior of a cell
    Lists neighbors;      ///< in A, sorted, itself included
    Lists jump_neighbors; ///< in J
    std::vector<bool> vertex;
  };
} // namespace mortise
