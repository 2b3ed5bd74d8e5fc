#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_q.h>

#include <mortise/body/elements/fe_simplex_legendre.h>
#include <mortise/body/elements/simplex_quadrature.h>
#include <mortise/operators/cells/linear_cell_matrices.h>

#include <algorithm>
#include <cmath>

namespace mortise
{
  using namespace dealii;

  LinearCellMatrices::Shared
  LinearCellMatrices::share(const Body &body)
  {
    std::unique_ptr<FiniteElement<dim>> element;
    Quadrature<dim>                     rule;
    if (body.mesh.tetrahedra)
      {
        element = std::make_unique<FE_SimplexLegendre>(1);
        rule = simplex_quadrature<dim>(1 + std::max(1u, body.mapping_degree));
      }
    else
      {
        element = std::make_unique<FE_Q<dim>>(1);
        rule    = QGauss<dim>(2);
      }
    std::vector<Tensor<1, dim>> gradients;
    for (const Point<dim> &point : rule.get_points())
      for (unsigned int i = 0; i < element->n_dofs_per_cell(); ++i)
        gradients.push_back(element->shape_grad(i, point));
    return {std::visit([](const auto &law) { return moduli(law); },
                       body.material.displacement_law()),
            rule,
            CellGeometry(body, element->reference_cell(), rule),
            gradients};
  }

  const FullMatrix<double> &
  LinearCellMatrices::of(const Body &body, const Body::CellIterator &cell)
  {
    auto found = by_body.find(body.index);
    if (found == by_body.end())
      found = by_body.emplace(body.index, share(body)).first;
    Shared            &shared = found->second;
    const Moduli      &C = tangents != nullptr && body.material.nonlinear() ?
                             (*tangents)[body.index][cell->active_cell_index()] :
                             shared.C;
    const unsigned int n = cell->n_vertices();
    const auto         constant = shared.geometry.constant_jacobian(cell);
    const auto        *varying =
      constant ? nullptr : shared.geometry.jacobians(cell).data();
    gradients.resize(shared.gradients.size());
    for (unsigned int q = 0; q < shared.rule.size(); ++q)
      {
        const CellGeometry::Jacobian &J = constant ? *constant : varying[q];
        const CellGeometry::Jacobian  to_space =
          std::sqrt(shared.rule.weight(q) * determinant(J)) * invert(J);
        for (unsigned int i = q * n; i < (q + 1) * n; ++i)
          gradients[i] = to_space * shared.gradients[i];
      }
    K.reinit(dim * n, dim * n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = i; j < n; ++j)
        {
          Tensor<2, dim> H;
          for (unsigned int q = 0; q < gradients.size(); q += n)
            H += outer_product(gradients[q + i], gradients[q + j]);
          for (unsigned int c = 0; c < dim; ++c)
            for (unsigned int d = 0; d < dim; ++d)
              {
                double sum = 0.;
                for (unsigned int e = 0; e < dim; ++e)
                  for (unsigned int f = 0; f < dim; ++f)
                    sum += C[c][e][d][f] * H[e][f];
                K(dim * i + c, dim * j + d) = K(dim * j + d, dim * i + c) = sum;
              }
        }
    return K;
  }
} // namespace mortise
