// The minimum rule: the polynomial degree of each edge and face of a mesh is
// the least of all cells around it, across hanging nodes and ranks, and the
// degree of freedom that stands for a mode there.
#pragma once

#include <deal.II/dofs/dof_handler.h>

#include <vector>

namespace mortise
{
  /// Degrees of edges and faces by the minimum rule, for a DoFHandler whose
  /// elements are FE_Legendre, FE_SimplexLegendre (as in SimplexElements; one
  /// level, no hanging nodes) or systems of one of them. The space is
  ///
  /// - cell interiors: all modes of the cell's degree;
  /// - faces, edges: modes up to the least degree of all cells that touch them
  /// with more than a
  ///   vertex, those on the finer side of a hanging face or edge included;
  /// - edges of a face that is refined on one side only: not above the degree
  /// of that face, since
  ///   their modes must be represented by every cell on its finer side.
  ///
  /// Valid on locally owned and ghost cells. The object must be rebuilt when
  /// the DoFHandler changes; it keeps a reference to it.
  class EntityDegrees
  {
  public:
    using CellIterator = dealii::DoFHandler<3>::active_cell_iterator;

    /// Collective over the ranks of @p dof_handler, whose degrees of freedom are distributed.
    explicit EntityDegrees(const dealii::DoFHandler<3> &dof_handler);

    /// Degree of line @p l of @p cell: 1 .. degree of the cell.
    unsigned int
    line_degree(const CellIterator &cell, unsigned int l) const
    {
      return uniform ? cell->get_fe().degree :
                       line_degrees[cell->line_index(l)];
    }

    /// Degree of face @p f of @p cell in both directions: 1 .. degree of the cell.
    unsigned int
    quad_degree(const CellIterator &cell, unsigned int f) const
    {
      return uniform ? cell->get_fe().degree :
                       quad_degrees[cell->face_index(f)];
    }

    /// Least degree of the cells that touch line @p l, or face @p f, of @p cell as a whole, as far
    /// as this rank sees them: not less than the above.
    unsigned int
    line_lattice(const CellIterator &cell, unsigned int l) const
    {
      return uniform ?
               cell->get_fe().degree :
               dof_handler.get_fe(line_element[cell->line_index(l)]).degree;
    }

    unsigned int
    quad_lattice(const CellIterator &cell, unsigned int f) const
    {
      return uniform ?
               cell->get_fe().degree :
               dof_handler.get_fe(quad_element[cell->face_index(f)]).degree;
    }

    /// Whether all cells of all ranks have one degree, and not more than two
    /// orders of vertices: get_master_dofs() then gives the cell's own degrees
    /// of freedom.
    bool
    one_degree() const
    {
      return uniform;
    }

    /// For each local degree of freedom of @p cell the global index of the one that carries its
    /// mode in the minimum-rule space: itself, that of a neighbour of another
    /// degree, or numbers::invalid_dof_index if the mode is above the degree of
    /// its edge or face (zero). Those of hanging edges and faces are not
    /// resolved to the coarse side here, and where a ghost cell is away from
    /// owned cells the result may be one that its owner ties to another:
    /// complete_constraints() makes that known. @p masters is resized to n_dofs_per_cell().
    void
    get_master_dofs(
      const CellIterator                           &cell,
      std::vector<dealii::types::global_dof_index> &masters) const;

  private:
    /// The element (index in the collection) that stands for an entity.
    using Entity = std::vector<unsigned char>;

    void
    collect_from_cells();
    void
    spread_over_hanging_faces();
    void
    spread_over_hanging_lines();
    void
    exchange_degrees();
    void
    lower(unsigned char &element, unsigned int candidate) const;
    void
    get_quadrilateral_masters(
      const CellIterator                           &cell,
      unsigned int                                  f,
      std::vector<dealii::types::global_dof_index> &masters) const;
    void
    get_triangle_masters(
      const CellIterator                           &cell,
      unsigned int                                  f,
      std::vector<dealii::types::global_dof_index> &masters) const;

    const dealii::DoFHandler<3> &dof_handler;
    bool                         uniform;
    Entity                       line_degrees, quad_degrees; ///< by index
    Entity vertex_element, line_element, quad_element;       ///< by index
  };
} // namespace mortise
