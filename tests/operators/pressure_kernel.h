// What the pressure adds to the matrix of one cell in mixed form, by dense
// products: what tests compare with.
#pragma once

#include <deal.II/lac/full_matrix.h>

#include <Teuchos_BLAS.hpp>
#include <mortise/operators/cells/cell_geometry.h>
#include <mortise/operators/cells/cell_kernel.h>

#include <array>
#include <cmath>
#include <vector>

namespace mortise::testing
{
  using namespace dealii;

  /// Values of the functions of a scalar element, [q][i].
  inline std::vector<double>
  element_values(const FiniteElement<dim> &element,
                 const Quadrature<dim>    &quadrature)
  {
    std::vector<double> table;
    for (const Point<dim> &point : quadrature.get_points())
      for (unsigned int i = 0; i < element.n_dofs_per_cell(); ++i)
        table.push_back(element.shape_value(i, point));
    return table;
  }

  /// What the cells of one pair of elements share.
  class PressureKernel
  {
  public:
    /// @p system, @p pressure: elements of displacement and pressure on the
    /// cells of @p body, which is kept by reference.
    PressureKernel(const Body               &body,
                   const FiniteElement<dim> &system,
                   const FiniteElement<dim> &pressure);

    /// With the pressures' functions Q_k and those of the displacement N_j in
    /// the numbering of the system,
    ///
    ///     G_kj = -int Q_k div N_j,   M_kl = int Q_k Q_l
    ///
    /// in divergence() and mass(). The Jacobian must be positive.
    void
    compute(const Body::CellIterator &cell);

    const FullMatrix<double> &
    divergence() const
    {
      return G;
    }

    const FullMatrix<double> &
    mass() const
    {
      return M;
    }

  private:
    const unsigned int                         n, n_pressures;
    std::array<std::vector<unsigned int>, dim> system_index;

    CellGeometry        geometry;
    std::vector<double> weights;
    std::vector<double> reference_gradients; ///< [q][a][i]
    std::vector<double> reference_values;    ///< of Q, [q][k]
    std::vector<double> gradients;           ///< w |J| dN/dx, [q][c][i]
    std::vector<double> values;              ///< sqrt(w |J|) Q, [q][k]
    std::vector<double> product;             ///< [k][c][i]
    FullMatrix<double>  G, M;
  };

  inline PressureKernel::PressureKernel(const Body               &body,
                                        const FiniteElement<dim> &system,
                                        const FiniteElement<dim> &pressure)
    : n(system.base_element(0).n_dofs_per_cell())
    , n_pressures(pressure.n_dofs_per_cell())
    , geometry(body,
               system.reference_cell(),
               stiffness_quadrature(system, body.mapping_degree))
    , product(n_pressures * dim * n)
    , G(n_pressures, dim * n)
    , M(n_pressures, n_pressures)
  {
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int i = 0; i < n; ++i)
        system_index[c].push_back(system.component_to_system_index(c, i));
    const Quadrature<dim> quadrature =
      stiffness_quadrature(system, body.mapping_degree);
    weights             = quadrature.get_weights();
    reference_gradients = element_gradients(system.base_element(0), quadrature);
    reference_values    = element_values(pressure, quadrature);
    gradients.resize(reference_gradients.size());
    values.resize(reference_values.size());
  }

  inline void
  PressureKernel::compute(const Body::CellIterator &cell)
  {
    const auto  constant = geometry.constant_jacobian(cell);
    const auto *all      = constant ? nullptr : geometry.jacobians(cell).data();
    const int   n_points = weights.size(), m = n_pressures, columns = dim * n;
    for (int q = 0; q < n_points; ++q)
      {
        const CellGeometry::Jacobian &jacobian = constant ? *constant : all[q];
        const double weight = weights[q] * determinant(jacobian);
        const CellGeometry::Jacobian inverse = weight * invert(jacobian);
        const double                *in  = &reference_gradients[q * columns];
        double                      *out = &gradients[q * columns];
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int i = 0; i < n; ++i)
            out[c * n + i] = inverse[c][0] * in[i] + inverse[c][1] * in[n + i] +
                             inverse[c][2] * in[2 * n + i];
        for (int k = 0; k < m; ++k)
          values[q * m + k] = std::sqrt(weight) * reference_values[q * m + k];
      }
    const Teuchos::BLAS<int, double> blas;
    // what is row major here is the transpose in column major order
    using namespace Teuchos;
    blas.GEMM(NO_TRANS,
              TRANS,
              columns,
              m,
              n_points,
              -1.,
              gradients.data(),
              columns,
              reference_values.data(),
              m,
              0.,
              product.data(),
              columns);
    blas.SYRK(
      LOWER_TRI, NO_TRANS, m, n_points, 1., values.data(), m, 0., &M(0, 0), m);
    for (int k = 0; k < m; ++k)
      {
        for (int l = k + 1; l < m; ++l)
          M(l, k) = M(k, l);
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int i = 0; i < n; ++i)
            G(k, system_index[c][i]) = product[k * columns + c * n + i];
      }
  }
} // namespace mortise::testing
