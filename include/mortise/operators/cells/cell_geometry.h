// Jacobians of a mapping on the cells of a mesh, at the points of one rule,
// without what else FEValues computes.
#pragma once

#include <deal.II/base/quadrature.h>

#include <mortise/base/tensor_product.h>
#include <mortise/base/types.h>
#include <mortise/body/body.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace mortise
{
  class HexahedralMapping;
  class SimplexMapping;

  class CellGeometry
  {
  public:
    /// dx_c/dxi_a as [a][c].
    using Jacobian = dealii::Tensor<2, dim>;

    /// For the cells of @p body of one shape, whose mapping is kept by
    /// reference; @p quadrature is a tensor product for hexahedra, with rules of
    /// its own in each direction.
    CellGeometry(const Body                    &body,
                 const dealii::ReferenceCell   &shape,
                 const dealii::Quadrature<dim> &quadrature);

    /// The Jacobian of a cell where it is constant to rounding; nothing for
    /// other cells.
    std::optional<Jacobian>
    constant_jacobian(const Body::CellIterator &cell) const;

    /// At all points, by x(xi) = sum_k N_k(xi) x_k.
    const std::vector<Jacobian> &
    jacobians(const Body::CellIterator &cell);

    /// The points of the rule in space.
    const std::vector<dealii::Point<dim>> &
    points(const Body::CellIterator &cell);

  private:
    const unsigned int    mapping_degree;
    const SimplexMapping *simplices; ///< none for hexahedra

    /// Barycentric coordinates of the nodes of a tetrahedron.
    std::vector<std::array<double, dim + 1>> barycentric;
    std::vector<double>                      nodal_values;    ///< [q][k]
    std::vector<double>                      nodal_gradients; ///< [q][a][k]
    /// Nodes of a hexahedron in lexicographic order, by component.
    std::array<TensorArray, dim>
    lexicographic_nodes(const Body::CellIterator &cell) const;

    const HexahedralMapping   *hexahedra; ///< none for tetrahedra
    std::vector<unsigned int>  lexicographic;
    std::array<LineTable, dim> lines; ///< of its nodes

    std::vector<Jacobian>           result;
    std::vector<dealii::Point<dim>> points_in_space;
  };

  /// Message for a @p cell whose Jacobian is not positive.
  std::string
  tangled_message(const Body &body, const Body::CellIterator &cell);
} // namespace mortise
