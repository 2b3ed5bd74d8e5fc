#include <mortise/body/elements/fe_legendre.h>
#include <mortise/operators/cells/cell_fields.h>
#include <mortise/operators/cells/lobatto_table.h>

namespace mortise
{
  using namespace dealii;

  CellCoefficients
  cell_coefficients(const Body               &body,
                    const Body::CellIterator &cell,
                    const BodySolution       &solution)
  {
    const auto       u = cell_coefficients(cell, solution.displacement);
    CellCoefficients result(u.begin(), u.end());
    if (body.pressure)
      result.push_back(
        scalar_coefficients(body.pressure->cell(cell), solution.pressure));
    return result;
  }

  struct CellFields::Hexahedra
  {
    Hexahedra(const Body            &body,
              const unsigned int     degree,
              const Quadrature<dim> &rule)
      : degree(degree)
      , weights(rule.get_weights())
      , geometry(body, ReferenceCells::Hexahedron, rule)
      , modes(cell_dof_indices(degree))
    {
      for (unsigned int d = 0; d < dim; ++d)
        lines[d] = lobatto_table(degree, rule.get_tensor_basis()[d]);
      if (!body.pressure)
        return;
      pressure_modes = cell_dof_indices(degree - 1);
      for (unsigned int d = 0; d < dim; ++d)
        pressure_lines[d] =
          lobatto_table(degree - 1, rule.get_tensor_basis()[d]);
    }

    const unsigned int              degree;
    const std::vector<double>       weights;
    CellGeometry                    geometry;
    const std::vector<unsigned int> modes;
    std::array<LineTable, dim>      lines, pressure_lines;
    std::vector<unsigned int>       pressure_modes;
  };

  CellFields::CellFields(const Body &body, const Rule &rule)
    : body(body)
    , rule(rule)
    , tetrahedra(body,
                 rule,
                 update_values | update_gradients | update_quadrature_points |
                   update_JxW_values)
  {}

  CellFields::~CellFields() = default;

  void
  CellFields::reinit(const Body::CellIterator &cell,
                     const BodySolution       &solution)
  {
    reinit(cell, cell_coefficients(body, cell, solution));
  }

  void
  CellFields::reinit(const Body::CellIterator &cell,
                     const CellCoefficients   &coefficients)
  {
    if (!body.mesh.tetrahedra)
      return evaluate_hexahedron(cell, coefficients);
    auto &from = tetrahedra(cell);
    from.reinit(Triangulation<dim>::cell_iterator(cell));
    points  = from.get_quadrature_points();
    weights = from.get_JxW_values();
    values.clear();
    gradients.clear();
    for (unsigned int q = 0; q < points.size(); ++q)
      {
        values.push_back(value(from, coefficients, q));
        gradients.push_back(gradient(from, coefficients, q));
      }
    if (body.pressure)
      {
        const auto own        = body.pressure->cell(cell);
        auto      &own_values = tetrahedra_pressure[own->active_fe_index()];
        if (!own_values)
          own_values = std::make_unique<FEValues<dim>>(*body.mapping,
                                                       own->get_fe(),
                                                       from.get_quadrature(),
                                                       update_values);
        own_values->reinit(Triangulation<dim>::cell_iterator(own));
        pressures = pressures_at(*own_values, coefficients.back());
      }
  }

  void
  CellFields::evaluate_hexahedron(const Body::CellIterator &cell,
                                  const CellCoefficients   &coefficients)
  {
    auto &shared = hexahedra[body.degree(cell)];
    if (!shared)
      shared = std::make_unique<Hexahedra>(body,
                                           body.degree(cell),
                                           rule(cell->get_fe()));
    const auto        &jacobians = shared->geometry.jacobians(cell);
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
          return apply_derivative(shared->lines, a, modes);
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
        TensorArray modes{{{n - 1, n - 1, n - 1}}, {}};
        for (const unsigned int i : shared->pressure_modes)
          modes.values.push_back(coefficients.back()[i]);
        pressures = apply_derivative(shared->pressure_lines, dim, modes).values;
      }
    weights.resize(n_points);
    for (unsigned int q = 0; q < n_points; ++q)
      {
        weights[q]   = determinant(jacobians[q]) * shared->weights[q];
        gradients[q] = gradients[q] * transpose(invert(jacobians[q]));
      }
  }
} // namespace mortise
