// A face of a hexahedron or tetrahedron in the coordinates in which its trace
// is described (trace_basis.h).
#pragma once

#include <deal.II/base/point.h>

#include <deal.II/dofs/dof_handler.h>

#include <mortise/body/elements/trace_basis.h>

#include <array>
#include <vector>

namespace mortise
{
  /// Face coordinates: of a hexahedron along its own directions (see
  /// face_topology.h); of a tetrahedron the barycentric coordinates of the
  /// face's second and third vertex in ascending order (see vertex_order.h).
  class CellFace
  {
  public:
    using CellIterator = dealii::DoFHandler<3>::active_cell_iterator;

    /// @p cell: with FE_Legendre, FE_SimplexLegendre or a system of one.
    CellFace(const CellIterator &cell, unsigned int face);

    /// Point of the unit cell at face coordinates (xi_1, xi_2), also beyond
    /// the face in its plane.
    dealii::Point<3>
    unit_point(double xi_1, double xi_2) const
    {
      return origin + xi_1 * along[0] + xi_2 * along[1];
    }

    const TraceBasis *basis;
    /// Scalar degrees of freedom of the cell, in the order of the basis.
    std::vector<unsigned int> indices;
    /// Numbers in the cell of the face's vertices and edges.
    std::array<unsigned int, 4> vertices;
    std::array<unsigned int, 4> lines;
    /// +1 if dx/dxi_1 x dx/dxi_2 points out of the cell (of positive volume),
    /// else -1.
    double orientation;

  private:
    dealii::Point<3>     origin; ///< in the unit cell
    dealii::Tensor<1, 3> along[2];
  };
} // namespace mortise
