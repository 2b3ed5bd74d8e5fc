#include <deal.II/base/quadrature_lib.h>

#include <mortise/body/fe_legendre.h>
#include <mortise/body/legendre_basis.h>
#include <mortise/body/simplex_quadrature.h>
#include <mortise/output/cell_fields.h>

namespace mortise
{
  using namespace dealii;

  struct CellFields::Hexahedra
  {
    Hexahedra(const Body &body, const unsigned int degree, const unsigned int n)
      : degree(degree)
      , quadrature(n)
      , geometry(body, ReferenceCells::Hexahedron, quadrature)
      , modes(cell_dof_indices(degree))
      , line_values(n, degree + 1)
      , line_slopes(n, degree + 1)
      , pressure_values(n, degree)
    {
      const QGauss<1>     line(n);
      std::vector<double> values(degree + 1), slopes(degree + 1);
      if (body.pressure)
        pressure_modes = cell_dof_indices(degree - 1);
      for (unsigned int q = 0; q < n; ++q)
        {
          if (body.pressure)
            {
              evaluate_lobatto(degree - 1, line.point(q)[0], values.data());
              for (unsigned int k = 0; k < degree; ++k)
                pressure_values(q, k) = values[k];
            }
          evaluate_lobatto(degree,
                           line.point(q)[0],
                           values.data(),
                           slopes.data());
          for (unsigned int k = 0; k <= degree; ++k)
            {
              line_values(q, k) = values[k];
              line_slopes(q, k) = slopes[k];
            }
        }
    }

    const unsigned int              degree;
    const QGauss<dim>               quadrature;
    CellGeometry                    geometry;
    const std::vector<unsigned int> modes;
    FullMatrix<double>              line_values, line_slopes;
    std::vector<unsigned int>       pressure_modes;
    FullMatrix<double>              pressure_values;
  };

  CellFields::CellFields(const Body &body, const unsigned int extra_points)
    : body(body)
    , extra_points(extra_points)
    , tetrahedra(
        body,
        [extra_points](const FiniteElement<dim> &element) {
          return gauss_quadrature<dim>(element, element.degree + extra_points);
        },
        update_values | update_gradients | update_quadrature_points |
          update_JxW_values)
    , tetrahedra_pressure(
        body,
        [extra_points](const FiniteElement<dim> &element) {
          return gauss_quadrature<dim>(element,
                                       element.degree + 1 + extra_points);
        },
        update_values)
  {}

  CellFields::~CellFields() = default;

  void
  CellFields::reinit(const Body::CellIterator &cell,
                     const BodySolution       &solution)
  {
    if (!body.mesh.tetrahedra)
      return evaluate_hexahedron(cell, solution);
    auto &from = tetrahedra(cell);
    from.reinit(Triangulation<dim>::cell_iterator(cell));
    const auto coefficients = cell_coefficients(cell, solution.displacement);
    points                  = from.get_quadrature_points();
    weights                 = from.get_JxW_values();
    values.clear();
    gradients.clear();
    for (unsigned int q = 0; q < points.size(); ++q)
      {
        values.push_back(value(from, coefficients, q));
        gradients.push_back(gradient(from, coefficients, q));
      }
    if (body.pressure)
      {
        const auto own    = body.pressure->cell(cell);
        auto      &values = tetrahedra_pressure(own);
        values.reinit(Triangulation<dim>::cell_iterator(own));
        pressures = pressures_at(own, values, solution.pressure);
      }
  }

  void
  CellFields::evaluate_hexahedron(const Body::CellIterator &cell,
                                  const BodySolution       &solution)
  {
    auto &shared = hexahedra[body.degree(cell)];
    if (!shared)
      shared = std::make_unique<Hexahedra>(body,
                                           body.degree(cell),
                                           body.degree(cell) + extra_points);
    const auto  coefficients = cell_coefficients(cell, solution.displacement);
    const auto &jacobians    = shared->geometry.jacobians(cell);
    const unsigned int n_points = jacobians.size(), n = shared->degree + 1;
    points = shared->geometry.points(cell);
    values.resize(n_points);
    gradients.resize(n_points);
    for (unsigned int c = 0; c < dim; ++c)
      {
        TensorArray modes{{{n, n, n}}, {}};
        for (const unsigned int i : shared->modes)
          modes.values.push_back(coefficients[c][i]);
        const auto along = [&](const unsigned int a) {
          return apply_derivative(shared->line_values,
                                  shared->line_slopes,
                                  a,
                                  modes);
        };
        const TensorArray value = along(dim);
        for (unsigned int q = 0; q < n_points; ++q)
          values[q][c] = value.values[q];
        for (unsigned int a = 0; a < dim; ++a)
          {
            const TensorArray slope = along(a);
            for (unsigned int q = 0; q < n_points; ++q)
              gradients[q][c][a] = slope.values[q]; // with respect to xi yet
          }
      }
    if (body.pressure)
      {
        const auto                           own = body.pressure->cell(cell);
        std::vector<types::global_dof_index> dofs(
          own->get_fe().n_dofs_per_cell());
        own->get_dof_indices(dofs);
        TensorArray modes{{{n - 1, n - 1, n - 1}}, {}};
        for (const unsigned int i : shared->pressure_modes)
          modes.values.push_back(solution.pressure(dofs[i]));
        const auto &along = shared->pressure_values;
        pressures         = apply_product(along, along, along, modes).values;
      }
    weights.resize(n_points);
    for (unsigned int q = 0; q < n_points; ++q)
      {
        weights[q]   = determinant(jacobians[q]) * shared->quadrature.weight(q);
        gradients[q] = gradients[q] * transpose(invert(jacobians[q]));
      }
  }
} // namespace mortise
