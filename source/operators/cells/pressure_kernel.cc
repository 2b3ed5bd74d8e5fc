#include <Teuchos_BLAS.hpp>
#include <mortise/operators/cells/cell_kernel.h>
#include <mortise/operators/cells/pressure_kernel.h>

#include <cmath>

namespace mortise
{
  using namespace dealii;

  PressureKernel::PressureKernel(const Body               &body,
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

  void
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
} // namespace mortise
