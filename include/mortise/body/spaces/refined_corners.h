// Nodes at the corners of cells that were refined, however far the cells on
// which the rank has them are.
#pragma once

#include <mortise/body/spaces/nodal_space.h>

#include <array>
#include <map>
#include <vector>

namespace mortise
{
  class RefinedCorners
  {
  public:
    using Index        = NodalSpace::Index;
    using Entries      = std::vector<std::pair<Index, double>>;
    using CellIterator = dealii::Triangulation<dim>::cell_iterator;

    /// @p vertices: of degree one in all bodies; kept by reference. Collective.
    RefinedCorners(const NodalSpace &vertices, MPI_Comm comm);

    /// Has this rank a part of the cell?
    bool
    is_local(const Body &body, const CellIterator &cell) const
    {
      return parts[body.index][cell->level()][cell->index()] != none;
    }

    /// At corner @p v of a cell; numbers::invalid_dof_index where the rank has
    /// not the part at the corner, unless it has another part of a refined
    /// cell.
    Index
    node(const Body &body, const CellIterator &cell, unsigned int v) const;

    /// entries += weight u(node), by nodes that do not hang.
    void
    add(Index node, double weight, Entries &entries) const;

  private:
    enum Part : char
    {
      none,
      some,
      all
    };

    /// Body, level and number of a cell here, and vertex.
    using Corner = std::array<unsigned int, 4>;

    static Corner
    corner(const Body &body, const CellIterator &cell, unsigned int v);
    void
    find_parts(const Body &body);
    Index
    own_node(const Body &body, const CellIterator &cell, unsigned int v) const;
    void
    exchange(MPI_Comm comm);

    const NodalSpace &vertices;
    /// By body, level and number of the cell.
    std::vector<std::vector<std::vector<Part>>> parts;
    /// By body and active cell, of owned cells.
    std::vector<std::vector<std::array<Index, 8>>> cell_nodes;
    std::map<Corner, Index>                        foreign; ///< of other ranks
    std::map<Index, Entries> foreign_lines; ///< of those that hang
  };
} // namespace mortise
