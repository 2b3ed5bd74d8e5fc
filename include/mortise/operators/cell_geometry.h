// Jacobians of a mapping on the cells of a mesh, at the points of one rule,
// without what else FEValues computes. It never evaluates shape functions.
#pragma once

#include <deal.II/base/quadrature.h>

#include <deal.II/fe/fe_dgq.h>
#include <deal.II/fe/fe_values.h>

#include <mortise/base/types.h>
#include <mortise/body/body.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mortise
{
  class SimplexMapping;

  class CellGeometry
  {
  public:
    /// dx_c/dxi_a as [a][c].
    using Jacobian = dealii::Tensor<2, dim>;

    /// For the cells of @p body of one shape, whose mapping is kept by reference.
    CellGeometry(const Body                    &body,
                 const dealii::ReferenceCell   &shape,
                 const dealii::Quadrature<dim> &quadrature);

    /// The Jacobian of a cell where it is constant to rounding; nothing for
    /// other cells.
    std::optional<Jacobian>
    constant_jacobian(const Body::CellIterator &cell) const;

    /// At all points, by x(xi) = sum_k N_k(xi) x_k on tetrahedra.
    const std::vector<Jacobian> &
    jacobians(const Body::CellIterator &cell);

  private:
    const unsigned int    mapping_degree;
    const SimplexMapping *simplices; ///< none for hexahedra

    /// Barycentric coordinates of the nodes of a tetrahedron.
    std::vector<std::array<double, dim + 1>> barycentric;
    std::vector<double>                      nodal_gradients; ///< [q][a][k]
    /// for hexahedra
    const dealii::FE_DGQ<dim>              constants{0};
    std::unique_ptr<dealii::FEValues<dim>> values;

    std::vector<Jacobian> result;
  };

  /// What to tell a user whose @p cell has a Jacobian that is not positive.
  std::string
  tangled_message(const Body &body, const Body::CellIterator &cell);
} // namespace mortise
