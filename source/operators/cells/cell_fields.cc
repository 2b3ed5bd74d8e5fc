#include <deal.II/fe/fe_poly.h>

#include <mortise/body/elements/fe_legendre.h>
#include <mortise/body/elements/simplex_basis.h>
#include <mortise/material/nonlinear_law.h>
#include <mortise/operators/cells/cell_fields.h>
#include <mortise/operators/cells/lobatto_table.h>

#include <algorithm>
#include <cmath>

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

  namespace
  {
    /// Functions of an element on the reference cell at points q: entry
    /// [i][d][q], d = 0 the value, then the derivatives along the axes.
    class FunctionTable
    {
    public:
      FunctionTable() = default;

      FunctionTable(const FiniteElement<dim> &element,
                    const Quadrature<dim>    &points,
                    const bool                with_derivatives)
        : n_points(points.size())
        , n_rows(n_points * (with_derivatives ? dim + 1 : 1))
      {
        entries.resize(element.n_dofs_per_cell() * n_rows);
        std::vector<Tensor<1, dim>> slopes;
        // all functions at once: one by one each takes as long
        const auto &polynomials =
          dynamic_cast<const FE_Poly<dim> &>(element).get_poly_space();
        for (unsigned int q = 0; q < n_points; ++q)
          {
            const auto values =
              values_at(polynomials, points.point(q), &slopes);
            for (unsigned int i = 0; i < values.size(); ++i)
              {
                double *row = &entries[i * n_rows + q];
                row[0]      = values[i];
                for (unsigned int d = 0; d < dim && with_derivatives; ++d)
                  row[(d + 1) * n_points] = slopes[i][d];
              }
          }
      }

      /// Of the function with @p coefficients: entry [d][q].
      std::vector<double>
      apply(const std::vector<double> &coefficients) const
      {
        std::vector<double> result(n_rows, 0.);
        const double       *row = entries.data();
        for (const double coefficient : coefficients)
          for (double &value : result)
            value += coefficient * *row++;
        return result;
      }

      unsigned int n_points = 0;

    private:
      unsigned int        n_rows = 0;
      std::vector<double> entries;
    };
  } // namespace

  struct CellFields::Tetrahedra
  {
    Tetrahedra(const Body               &body,
               const Body::CellIterator &cell,
               const Quadrature<dim>    &rule)
      : weights(rule.get_weights())
      , geometry(body, ReferenceCells::Tetrahedron, rule)
      , displacement(cell->get_fe().base_element(0), rule, true)
    {
      if (body.pressure)
        pressure =
          FunctionTable(body.pressure->cell(cell)->get_fe(), rule, false);
    }

    const std::vector<double> weights;
    CellGeometry              geometry;
    const FunctionTable       displacement;
    FunctionTable             pressure;
  };

  CellFields::CellFields(const Body &body, const Rule &rule)
    : body(body)
    , rule(rule)
  {}

  CellFields::~CellFields() = default;

  void
  CellFields::reinit(const Body::CellIterator &cell,
                     const BodySolution       &solution)
  {
    reinit(cell, cell_coefficients(body, cell, solution));
    histories.clear();
    if (!solution.history.empty())
      {
        auto &values = by_element[cell->active_fe_index()];
        if (!values)
          values = std::make_unique<Histories>(body, rule(cell->get_fe()));
        histories =
          values->values.evaluate(cell,
                                  solution.history[cell->active_cell_index()]);
      }
    thermal_strains.clear();
    if (solution.thermal_strain)
      for (const Point<dim> &x : points)
        thermal_strains.push_back(solution.thermal_strain(x));
  }

  double
  CellFields::thermal_stretch(const unsigned int q) const
  {
    return body.material.thermal_stretch(
      thermal_strains.empty() ? 0. : thermal_strains[q]);
  }

  Tensor<2, dim>
  CellFields::elastic(const Tensor<2, dim> &gradient,
                      const unsigned int    q) const
  {
    return body.material.elastic_gradient(
      gradient, thermal_strains.empty() ? 0. : thermal_strains[q]);
  }

  Material::Response
  CellFields::respond(const unsigned int q) const
  {
    Material::Response result =
      body.material.respond(elastic(gradients[q], q),
                            pressures.empty() ? 0. : pressures[q],
                            history(q));
    result.nominal *= std::pow(thermal_stretch(q), 2);
    return result;
  }

  Tensor<2, dim>
  CellFields::nominal_change(const unsigned int    q,
                             const Tensor<2, dim> &change,
                             const double          pressure_change) const
  {
    const double stretch = thermal_stretch(q);
    return stretch * stretch *
           body.material.nominal_change(elastic(gradients[q], q),
                                        pressures.empty() ? 0. : pressures[q],
                                        change / stretch,
                                        pressure_change);
  }

  double
  CellFields::tangent_product(const unsigned int q,
                              const CellFields  &a,
                              const CellFields  &b) const
  {
    const Material &material = body.material;
    if (!material.mixed())
      return scalar_product(nominal_change(q, a.gradients[q], 0.),
                            b.gradients[q]);
    // the pressure's column is the row of the dilatation
    const Tensor<2, dim> by_pressure = nominal_change(q, Tensor<2, dim>(), 1.);
    const double slope = material.dilatation_of_pressure(pressures[q]).slope;
    return scalar_product(nominal_change(q, a.gradients[q], a.pressures[q]),
                          b.gradients[q]) +
           b.pressures[q] * (scalar_product(by_pressure, a.gradients[q]) +
                             slope * a.pressures[q]);
  }

  double
  CellFields::missing_dilatation(const unsigned int q) const
  {
    return body.material.dilatation(elastic(gradients[q], q)) -
           body.material.dilatation_of_pressure(pressures[q]).value;
  }

  const double *
  CellFields::history(const unsigned int q) const
  {
    return histories.empty() ?
             nullptr :
             &histories[q * body.material.nonlinear()->n_history()];
  }

  double
  CellFields::plastic_strain(const unsigned int q) const
  {
    const NonlinearLaw *law = body.material.nonlinear().get();
    if (histories.empty() || !law->plastic_strain())
      return 0.;
    // polynomials may be less
    return std::max(0., history(q)[*law->plastic_strain()]);
  }

  SymmetricTensor<2, dim>
  CellFields::stress(const unsigned int q) const
  {
    return respond(q).cauchy;
  }

  void
  CellFields::reinit(const Body::CellIterator &cell,
                     const CellCoefficients   &coefficients)
  {
    if (body.mesh.tetrahedra)
      evaluate_tetrahedron(cell, coefficients);
    else
      evaluate_hexahedron(cell, coefficients);
  }

  void
  CellFields::map_to_space(const std::vector<CellGeometry::Jacobian> &jacobians,
                           const std::vector<double> &reference_weights)
  {
    weights.resize(jacobians.size());
    for (unsigned int q = 0; q < jacobians.size(); ++q)
      {
        weights[q]   = determinant(jacobians[q]) * reference_weights[q];
        gradients[q] = gradients[q] * transpose(invert(jacobians[q]));
      }
  }

  void
  CellFields::evaluate_tetrahedron(const Body::CellIterator &cell,
                                   const CellCoefficients   &coefficients)
  {
    auto &shared = tetrahedra[cell->active_fe_index()];
    if (!shared)
      shared = std::make_unique<Tetrahedra>(body, cell, rule(cell->get_fe()));
    const unsigned int n_points = shared->displacement.n_points;
    points                      = shared->geometry.points(cell);
    values.resize(n_points);
    gradients.resize(n_points);
    for (unsigned int c = 0; c < dim; ++c)
      {
        const auto at = shared->displacement.apply(coefficients[c]);
        for (unsigned int q = 0; q < n_points; ++q)
          {
            values[q][c] = at[q];
            for (unsigned int a = 0; a < dim; ++a)
              gradients[q][c][a] = at[(a + 1) * n_points + q];
          }
      }
    if (body.pressure)
      pressures = shared->pressure.apply(coefficients.back());
    map_to_space(shared->geometry.jacobians(cell), shared->weights);
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
    map_to_space(jacobians, shared->weights);
  }
} // namespace mortise
