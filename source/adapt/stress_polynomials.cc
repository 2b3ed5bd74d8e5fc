#include <deal.II/fe/fe_poly.h>

#include <mortise/adapt/stress_polynomials.h>
#include <mortise/base/lagrange.h>
#include <mortise/body/elements/simplex_basis.h>
#include <mortise/body/elements/simplex_quadrature.h>
#include <mortise/operators/cells/cell_histories.h>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// At @p x, of the polynomials that are one at one of @p nodes and zero at the others.
    std::vector<double>
    lagrange_at(const std::vector<Point<1>> &nodes, const double x)
    {
      std::vector<double> result(nodes.size(), 1.);
      for (unsigned int i = 0; i < nodes.size(); ++i)
        for (unsigned int j = 0; j < nodes.size(); ++j)
          if (i != j)
            result[i] *= (x - nodes[j][0]) / (nodes[i][0] - nodes[j][0]);
      return result;
    }

    /// The functions of a tetrahedron at one point; slopes cost several times
    /// as much as values.
    struct Functions
    {
      Functions(const FiniteElement<dim> &element,
                const Point<dim>         &x,
                const bool                with_slopes)
        // all at once: one by one each takes as long
        : values(values_at(
            dynamic_cast<const FE_Poly<dim> &>(element).get_poly_space(),
            x,
            with_slopes ? &slopes : nullptr))
      {}

      std::vector<Tensor<1, dim>> slopes;
      std::vector<double>         values;
    };
  } // namespace

  StressPolynomials::StressPolynomials(const Body               &body,
                                       const FiniteElement<dim> &element)
    : geometry(body, element.reference_cell(), rule(body, element))
    , element(element.base_element(0))
    , simplex(body.mesh.tetrahedra)
  {
    if (simplex)
      prepare_tetrahedra(body);
    else
      prepare_hexahedra(body);
  }

  namespace
  {
    /// Points per direction. Where points remember something, forces are in
    /// equilibrium at their own points with a plastic front between them, which
    /// others see.
    unsigned int
    n_nodes(const Body &body, const FiniteElement<dim> &element)
    {
      return element.degree + (has_history(body) ? 2 : 1);
    }
  } // namespace

  Quadrature<dim>
  StressPolynomials::nodes(const Body &body, const FiniteElement<dim> &element)
  {
    return gauss_quadrature<dim>(element, n_nodes(body, element));
  }

  Quadrature<dim>
  StressPolynomials::rule(const Body &body, const FiniteElement<dim> &element)
  {
    return gauss_quadrature<dim>(element, n_nodes(body, element) + 1);
  }

  void
  StressPolynomials::prepare_hexahedra(const Body &body)
  {
    const Quadrature<1> from = nodes(body, element).get_tensor_basis()[0],
                        to   = rule(body, element).get_tensor_basis()[0];
    line                     = from.get_points();
    to_rule.fill({lagrange_values(from, to), lagrange_derivatives(from, to)});
    for (const double side : {0., 1.})
      ends.push_back(lagrange_at(line, side));
  }

  void
  StressPolynomials::prepare_tetrahedra(const Body &body)
  {
    const Quadrature<dim> from = nodes(body, element), to = rule(body, element);
    const unsigned int    n = element.n_dofs_per_cell(), m = from.size();
    FullMatrix<double>    mass(n, n), moments(n, m), inverse(n, n);
    for (unsigned int q = 0; q < m; ++q)
      {
        const auto values = Functions(element, from.point(q), false).values;
        for (unsigned int i = 0; i < n; ++i)
          {
            moments(i, q) = from.weight(q) * values[i];
            for (unsigned int j = 0; j < n; ++j)
              mass(i, j) += moments(i, q) * values[j];
          }
      }
    inverse.invert(mass);
    projection.reinit(n, m);
    inverse.mmult(projection, moments);
    FullMatrix<double> slopes(dim * to.size(), n);
    for (unsigned int q = 0; q < to.size(); ++q)
      {
        const Functions at(element, to.point(q), true);
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int d = 0; d < dim; ++d)
            slopes(d * to.size() + q, i) = at.slopes[i][d];
      }
    derivatives.reinit(slopes.m(), m);
    slopes.mmult(derivatives, projection);
  }

  FullMatrix<double>
  StressPolynomials::slopes(const std::vector<Tensor<2, dim>> &stresses) const
  {
    constexpr unsigned int n_components =
      Tensor<2, dim>::n_independent_components;
    FullMatrix<double> values(stresses.size(), n_components);
    for (unsigned int c = 0; c < n_components; ++c)
      {
        const auto at = Tensor<2, dim>::unrolled_to_component_indices(c);
        for (unsigned int k = 0; k < stresses.size(); ++k)
          values(k, c) = stresses[k][at];
      }
    if (simplex)
      {
        FullMatrix<double> result(derivatives.m(), n_components);
        derivatives.mmult(result, values);
        return result;
      }
    const unsigned int  n = line.size();
    FullMatrix<double>  result;
    std::vector<double> of_component(stresses.size());
    for (unsigned int c = 0; c < n_components; ++c)
      {
        for (unsigned int k = 0; k < stresses.size(); ++k)
          of_component[k] = values(k, c);
        for (unsigned int a = 0; a < dim; ++a)
          {
            const auto slope =
              apply_derivative(to_rule, a, {{{n, n, n}}, of_component}).values;
            if (result.empty())
              result.reinit(dim * slope.size(), n_components);
            for (unsigned int q = 0; q < slope.size(); ++q)
              result(a * slope.size() + q, c) = slope[q];
          }
      }
    return result;
  }

  std::vector<Tensor<1, dim>>
  StressPolynomials::divergence(const Body::CellIterator          &cell,
                                const std::vector<Tensor<2, dim>> &stresses)
  {
    const auto                 &jacobians = geometry.jacobians(cell);
    std::vector<Tensor<1, dim>> result(jacobians.size());
    std::vector<Tensor<2, dim>> inverse; // dxi_a / dx_j as [j][a]
    for (const auto &jacobian : jacobians)
      inverse.push_back(invert(jacobian));
    const FullMatrix<double> along = slopes(stresses);
    for (unsigned int c = 0; c < Tensor<2, dim>::n_independent_components; ++c)
      {
        const auto at = Tensor<2, dim>::unrolled_to_component_indices(c);
        for (unsigned int a = 0; a < dim; ++a)
          for (unsigned int q = 0; q < result.size(); ++q)
            {
              const double slope = along(a * result.size() + q, c);
              result[q][at[0]] += slope * inverse[q][at[1]][a];
            }
      }
    return result;
  }

  std::vector<Tensor<2, dim>>
  StressPolynomials::on_face(const unsigned int                 f,
                             const std::vector<Tensor<2, dim>> &stresses) const
  {
    if (simplex)
      {
        std::vector<Tensor<2, dim>> result(projection.m());
        for (unsigned int i = 0; i < projection.m(); ++i)
          for (unsigned int q = 0; q < projection.n(); ++q)
            result[i] += projection(i, q) * stresses[q];
        return result;
      }
    const unsigned int          n = line.size(), d = f / 2;
    const unsigned int          step = d == 0 ? 1 : d == 1 ? n : n * n;
    const auto                 &end  = ends[f % 2];
    std::vector<Tensor<2, dim>> result;
    result.reserve(n * n);
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
        {
          const unsigned int first = d == 0 ? (i + j * n) * n :
                                     d == 1 ? i + j * n * n :
                                              i + j * n;
          Tensor<2, dim>     sum;
          for (unsigned int k = 0; k < n; ++k)
            sum += end[k] * stresses[first + k * step];
          result.push_back(sum);
        }
    return result;
  }

  std::vector<double>
  StressPolynomials::factors_on_face(const unsigned int f,
                                     const Point<dim>  &x) const
  {
    if (simplex)
      return Functions(element, x, false).values;
    std::vector<double> result;
    const unsigned int  d     = f / 2;
    const auto          first = lagrange_at(line, x[d == 0 ? 1 : 0]),
               second         = lagrange_at(line, x[d == 2 ? 1 : 2]);
    for (const double b : second)
      for (const double a : first)
        result.push_back(a * b);
    return result;
  }
} // namespace mortise
