// The curved shape of the coarse cells of a second-order mesh: points of
// refined cells and of mappings of any degree on it.
#pragma once

#include <deal.II/base/point.h>

#include <deal.II/grid/tria.h>

#include <mortise/base/rigid_motion.h>

#include <vector>

namespace mortise
{
  /// A polynomial of degree 2 on each coarse cell: of 27 nodes, lexicographic
  /// on the unit cube, or of 10, the vertices and then the middles of
  /// tetrahedron_lines. Cells of a triangulation know theirs by the id of their
  /// coarse cell; however the triangulation numbers the vertices of that cell,
  /// they must be at the places of its first-order nodes.
  class CoarseGeometry
  {
  public:
    using CellIterator = dealii::Triangulation<3>::cell_iterator;

    /// No cells.
    CoarseGeometry() = default;

    /// @p nodes_per_cell: 27 or 10.
    CoarseGeometry(unsigned int                         nodes_per_cell,
                   const std::vector<dealii::Point<3>> &nodes);

    std::size_t
    n_cells() const
    {
      return nodes_per_cell == 0 ? 0 : nodes.size() / nodes_per_cell;
    }

    /// Point of coarse cell @p cell, and the derivatives of its coordinates in
    /// rows, at @p unit of the unit cube or tetrahedron, in the numbering of
    /// the nodes.
    dealii::Point<3>
    point(std::size_t cell, const dealii::Point<3> &unit) const;
    dealii::Tensor<2, 3>
    jacobian(std::size_t cell, const dealii::Point<3> &unit) const;

    /// The points of @p cell, coarse or (of hexahedra) refined, at @p unit of its own reference
    /// cell: what MappingQCache::initialize() and SimplexMapping ask for.
    std::vector<dealii::Point<3>>
    points(const CellIterator                  &cell,
           const std::vector<dealii::Point<3>> &unit) const;

    /// Put all vertices of @p triangulation, artificial cells included, on the
    /// curved shape: after each refinement, which places new ones on flat
    /// cells. Not collective; the same on every rank.
    void
    place_vertices(dealii::Triangulation<3> &triangulation) const;

    /// Put the @p vertices of coarse @p cells (hexahedra, numbered like the
    /// nodes) on the corners of the shape.
    void
    place_vertices(const std::vector<dealii::CellData<3>> &cells,
                   std::vector<dealii::Point<3>>          &vertices) const;

    /// Shape of the children of all cells (hexahedra), in deal.II's order.
    CoarseGeometry
    refined() const;

    /// Shape without the cells that are not in @p kept, in the order of @p kept.
    CoarseGeometry
    selected(const std::vector<std::size_t> &kept) const;

    void
    move(const RigidMotion &motion)
    {
      for (dealii::Point<3> &node : nodes)
        node = motion(node);
    }

    unsigned int                  nodes_per_cell = 0;
    std::vector<dealii::Point<3>> nodes; ///< cell by cell

  private:
    /// Of the lines of the unit cell of @p cell in that of its coarse cell.
    struct Placement
    {
      dealii::Point<3>     origin;
      dealii::Tensor<2, 3> directions; ///< in columns
      std::size_t          coarse_cell = 0;
    };
    Placement
    placement(const CellIterator &cell) const;
    Placement
    root_placement(const CellIterator &cell) const;
  };

  /// Nodes of a hexahedron of 20 nodes (corners and middles of edges of @p nodes,
  /// lexicographic of 27) completed by serendipity: middles of faces and the
  /// centre such that no mode of a face or of the inside is there.
  void
  complete_serendipity(std::vector<dealii::Point<3>> &nodes);
} // namespace mortise
