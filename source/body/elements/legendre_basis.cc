#include <deal.II/base/quadrature_lib.h>

#include <mortise/body/elements/legendre_basis.h>

#include <array>
#include <cmath>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int n_functions = max_lobatto_degree + 1;

    /// sqrt(2k-1), the scaling of bubble k.
    constexpr std::array<double, n_functions> bubble_scaling = {
      {0.,
       1.,
       1.7320508075688772935,
       2.2360679774997896964,
       2.6457513110645905905,
       3.,
       3.3166247903553998491,
       3.6055512754639892931,
       3.8729833462074168852}};
  } // namespace

  void
  evaluate_lobatto(const unsigned int degree,
                   const double       x,
                   double *const      values,
                   double *const      derivatives,
                   double *const      second)
  {
    Assert(degree >= 1 && degree <= max_lobatto_degree,
           ExcIndexRange(degree, 1, n_functions));

    values[0] = 1. - x;
    values[1] = x;
    if (derivatives != nullptr)
      {
        derivatives[0] = -1.;
        derivatives[1] = 1.;
      }
    if (second != nullptr)
      second[0] = second[1] = 0.;

    // At the beginning of step k: lower = P_{k-2}, p = P_{k-1}; their
    // derivatives likewise.
    const double t     = 2. * x - 1.;
    double       lower = 1., p = t;
    double       lower_slope = 0., slope = 1.;
    for (unsigned int k = 2; k <= degree; ++k)
      {
        // k P_k = (2k-1) t P_{k-1} - (k-1) P_{k-2};  P_k' = P_{k-2}' + (2k-1)
        // P_{k-1}
        const double next = ((2. * k - 1.) * t * p - (k - 1.) * lower) / k;
        const double next_slope = lower_slope + (2. * k - 1.) * p;
        values[k]               = (next - lower) / (2. * bubble_scaling[k]);
        if (derivatives != nullptr)
          derivatives[k] = bubble_scaling[k] * p;
        if (second != nullptr)
          second[k] = 2. * bubble_scaling[k] * slope;
        lower       = p;
        p           = next;
        lower_slope = slope;
        slope       = next_slope;
      }
  }

  namespace
  {
    FullMatrix<double>
    compute_restriction(const unsigned int child)
    {
      using Values             = std::array<double, n_functions>;
      constexpr unsigned int p = max_lobatto_degree;
      FullMatrix<double>     restriction(n_functions, n_functions);
      Values                 left, right;
      evaluate_lobatto(p, 0.5 * child, left.data());
      evaluate_lobatto(p, 0.5 * (child + 1), right.data());
      for (unsigned int j = 0; j < n_functions; ++j)
        {
          restriction(0, j) = left[j];
          restriction(1, j) = right[j];
        }

      // The bubbles' derivatives are orthonormal and orthogonal to constants:
      // R(i,j) = int_0^1 d/dy N_j(x(y)) N_i'(y) dy.
      const QGauss<1> quadrature(n_functions);
      Values          values, parent, own;
      for (unsigned int q = 0; q < quadrature.size(); ++q)
        {
          const double y = quadrature.point(q)[0];
          evaluate_lobatto(p, 0.5 * (child + y), values.data(), parent.data());
          evaluate_lobatto(p, y, values.data(), own.data());
          for (unsigned int i = 2; i < n_functions; ++i)
            for (unsigned int j = i; j < n_functions; ++j)
              restriction(i, j) +=
                quadrature.weight(q) * 0.5 * parent[j] * own[i];
        }
      for (unsigned int i = 0; i < n_functions; ++i)
        for (unsigned int j = 0; j < n_functions; ++j)
          if (std::abs(restriction(i, j)) < 1e-14)
            restriction(i, j) = 0.;
      return restriction;
    }
  } // namespace

  const FullMatrix<double> &
  lobatto_restriction(const unsigned int child)
  {
    static const std::array<FullMatrix<double>, 2> restrictions = {
      {compute_restriction(0), compute_restriction(1)}};
    AssertIndexRange(child, 2);
    return restrictions[child];
  }

  FullMatrix<double>
  lobatto_merging(const unsigned int degree, const unsigned int child)
  {
    const FullMatrix<double> &restriction = lobatto_restriction(child);
    FullMatrix<double>        result(degree + 1, degree + 1);
    result(child, child) = 1.;
    // int_0^1 N_k' u' dx, where slopes on a half are twice those in its own
    // coordinate
    for (unsigned int k = 2; k <= degree; ++k)
      {
        const double slope = restriction(1, k) - restriction(0, k);
        result(k, 0)       = -2. * slope;
        result(k, 1)       = 2. * slope;
        for (unsigned int i = 2; i <= degree; ++i)
          result(k, i) = 2. * restriction(i, k);
      }
    return result;
  }

  namespace
  {
    /// N_k as a product of its roots: 0, 1 and the roots of P'_{k-1}, that is
    /// the k points of the Gauss-Lobatto rule. deal.II's product form is one at
    /// the extra point given last.
    Polynomials::Polynomial<double>
    bubble_polynomial(const unsigned int k)
    {
      std::vector<Point<1>> points = QGaussLobatto<1>(k).get_points();
      points.front()[0]            = 0.;
      points.back()[0]             = 1.;
      const double at =
        k % 2 == 0 ?
          0.5 :
          0.5 * (points[(k - 1) / 2][0] + points[(k - 1) / 2 + 1][0]);
      points.emplace_back(at);

      std::array<double, n_functions> values;
      evaluate_lobatto(k, at, values.data());
      Polynomials::Polynomial<double> bubble(points, k);
      bubble *= values[k];
      return bubble;
    }
  } // namespace

  std::vector<Polynomials::Polynomial<double>>
  lobatto_polynomials(const unsigned int degree)
  {
    AssertThrow(degree >= 1 && degree <= max_lobatto_degree,
                ExcIndexRange(degree, 1, n_functions));
    const std::vector<Point<1>> ends = {Point<1>(0.), Point<1>(1.)};
    std::vector<Polynomials::Polynomial<double>> polynomials;
    polynomials.reserve(degree + 1);
    polynomials.emplace_back(ends, 0);
    for (unsigned int k = 2; k <= degree; ++k)
      polynomials.push_back(bubble_polynomial(k));
    polynomials.emplace_back(ends, 1);
    return polynomials;
  }
} // namespace mortise
