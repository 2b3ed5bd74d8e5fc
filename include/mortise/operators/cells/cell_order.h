// Between values at the nodes of a cell and hierarchical coefficients.
#pragma once

#include <deal.II/fe/fe.h>

#include <deal.II/lac/full_matrix.h>

#include <mortise/base/types.h>

#include <array>
#include <vector>

namespace mortise
{
  /// Values of one component on a hexahedron, in the order of
  /// cell_dof_indices(), times @p matrix along each direction.
  void
  transform_along_lines(const dealii::FullMatrix<double> &matrix,
                        std::vector<double>              &values);

  /// Change of basis on the cells of one element of a body.
  class CellOrder
  {
  public:
    /// @p element: FE_Legendre or FE_SimplexLegendre, or a system of three.
    explicit CellOrder(const dealii::FiniteElement<dim> &element);

    /// Of the function whose coefficients values[] holds.
    void
    transform_to_nodes();

    /// The way back.
    void
    transform_to_modes();

    /// Of the functional that values[] holds for modes.
    void
    transform_functional_to_nodes();

    const unsigned int degree;
    const bool         tetrahedra;
    /// By index in values[]: the node of the cell, and its dof by component.
    const std::vector<unsigned int>            scalar;
    std::array<std::vector<unsigned int>, dim> modes;
    std::vector<double>                        values;
  };
} // namespace mortise
