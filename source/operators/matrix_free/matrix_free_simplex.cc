// See simplex_tables.h.
#include <mortise/body/elements/simplex_nodes.h>
#include <mortise/body/elements/simplex_quadrature.h>
#include <mortise/operators/matrix_free/nonlinear_kernel_on.h>
#include <mortise/operators/matrix_free/simplices.h>

#include <cmath>
#include <map>
#include <mutex>
#include <type_traits>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Result of @p make, computed once for each degree.
    template <typename Make>
    const FullMatrix<double> &
    made_once(const unsigned int degree, const Make &make)
    {
      static std::mutex                                 mutex;
      static std::map<unsigned int, FullMatrix<double>> made;
      const std::lock_guard<std::mutex>                 lock(mutex);
      const auto found = made.find(degree);
      return found != made.end() ? found->second :
                                   made.emplace(degree, make()).first->second;
    }

    /// L with M = L L^T, the mass matrix of the nodal functions of @p degree.
    FullMatrix<double>
    factor_of_mass(const unsigned int degree)
    {
      const Quadrature<dim> rule = simplex_quadrature<dim>(2 * degree);
      FullMatrix<double>    values(rule.size(), 1);
      if (degree > 0)
        values = simplex_nodal_values(degree, rule.get_points());
      else
        for (unsigned int q = 0; q < rule.size(); ++q)
          values(q, 0) = 1.;
      for (unsigned int q = 0; q < rule.size(); ++q)
        for (unsigned int i = 0; i < values.n(); ++i)
          values(q, i) *= std::sqrt(rule.weight(q));
      FullMatrix<double> mass(values.n()), factor(values.n());
      values.Tmmult(mass, values);
      factor.cholesky(mass);
      return factor;
    }
  } // namespace

  const FullMatrix<double> &
  gradient_coefficients(const unsigned int degree)
  {
    return made_once(degree, [&] {
      // f . M g = (L^T f) . (L^T g) for values f, g at nodes, M = L L^T
      const std::vector<Point<dim>> nodes =
        degree == 1 ? std::vector<Point<dim>>(1) : simplex_nodes(degree - 1);
      const unsigned int       n      = nodes.size();
      const FullMatrix<double> factor = factor_of_mass(degree - 1),
                               gradients =
                                 simplex_nodal_gradients(degree, nodes);
      FullMatrix<double> result(dim * n, gradients.n());
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = i; j < n; ++j)
            for (unsigned int k = 0; k < result.n(); ++k)
              result(d * n + i, k) += factor(j, i) * gradients(d * n + j, k);
      return result;
    });
  }

  FullMatrix<double>
  pressure_coefficients(const unsigned int degree)
  {
    return transposed(factor_of_mass(degree - 1));
  }

  template <typename Number>
  Quadrature<dim>
  simplex_rule(const unsigned int degree)
  {
    if (degree >= sum_factorised_from)
      return collapsed_quadrature<dim>(2 * degree);
    return simplex_quadrature<dim>(2 * degree -
                                   (std::is_same_v<Number, float> ? 1 : 0));
  }

  template Quadrature<dim>
  simplex_rule<float>(unsigned int);
  template Quadrature<dim>
  simplex_rule<double>(unsigned int);

  Tensor<2, dim>
  simplex_rule_jacobian(const unsigned int degree, const Point<dim> &x)
  {
    Tensor<2, dim> result;
    if (degree < sum_factorised_from)
      {
        for (unsigned int a = 0; a < dim; ++a)
          result[a][a] = 1.;
        return result;
      }
    const double y_1 = x[1] / (1. - x[2]), y_0 = x[0] / (1. - x[1] - x[2]);
    result[0][0] = (1. - y_1) * (1. - x[2]);
    result[1][0] = -y_0 * (1. - x[2]);
    result[1][1] = 1. - x[2];
    result[2][0] = -y_0 * (1. - y_1);
    result[2][1] = -y_1;
    result[2][2] = 1.;
    return result;
  }

  template <typename Number>
  const FullMatrix<double> &
  gradients_on_curved(const unsigned int degree)
  {
    return made_once(degree, [&] {
      const auto         points = simplex_rule<Number>(degree).get_points();
      const unsigned int n      = points.size();
      const FullMatrix<double> along_axes =
        simplex_nodal_gradients(degree, points);
      FullMatrix<double> result(dim * n, along_axes.n());
      for (unsigned int q = 0; q < n; ++q)
        {
          const Tensor<2, dim> J = simplex_rule_jacobian(degree, points[q]);
          for (unsigned int a = 0; a < dim; ++a)
            for (unsigned int b = 0; b < dim; ++b)
              for (unsigned int k = 0; k < along_axes.n(); ++k)
                result(a * n + q, k) += J[a][b] * along_axes(b * n + q, k);
        }
      return result;
    });
  }

  template const FullMatrix<double> &
  gradients_on_curved<float>(unsigned int);
  template const FullMatrix<double> &
  gradients_on_curved<double>(unsigned int);

  template <typename Number>
  std::unique_ptr<typename MatrixFreeElasticity<Number>::Kernel>
  MatrixFreeElasticity<Number>::make_simplex_kernel(
    const CellBatches<Number> &cells)
  {
    return with_degree<1>(cells.degree, [&](const auto degree) {
      return make_kernel_on<Simplices<Number, degree>>(cells);
    });
  }

  template std::unique_ptr<MatrixFreeElasticity<float>::Kernel>
  MatrixFreeElasticity<float>::make_simplex_kernel(const CellBatches<float> &);
  template std::unique_ptr<MatrixFreeElasticity<double>::Kernel>
  MatrixFreeElasticity<double>::make_simplex_kernel(
    const CellBatches<double> &);
} // namespace mortise
