#include <mortise/adapt/smoothness.h>
#include <mortise/body/elements/fe_legendre.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace mortise
{
  namespace
  {
    /// Directions with less in the highest degree, as a square beside the
    /// largest, do not matter.
    constexpr double least_part = 0.05;

    /// Square of a function of evaluate_lobatto() over [0, 1], about.
    double
    square(const unsigned int k)
    {
      return k < 2 ? 1. / 3. : 1. / (2. * (2. * k - 3.) * (2. * k + 1.));
    }

    /// A function of @p degree is a sum of functions of x_d times ones of the other two coordinates: for
    /// each of the former call visit(weight, at), with the coefficients at(k)
    /// of evaluate_lobatto() and the square of the latter, about.
    template <typename Visit>
    void
    for_each_line(const unsigned int         degree,
                  const unsigned int         d,
                  const std::vector<double> &coefficients,
                  const Visit               &visit)
    {
      const auto                        modes = cell_dof_indices(degree);
      const unsigned int                n     = degree + 1;
      const std::array<unsigned int, 3> stride{{1, n, n * n}};
      const unsigned int                e = (d + 1) % 3, f = (d + 2) % 3;
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          visit(square(i) * square(j), [&](const unsigned int k) {
            return coefficients[modes[k * stride[d] + i * stride[e] +
                                      j * stride[f]]];
          });
    }

    /// Squares of the coefficients of d/dx_d by the degree of the Legendre
    /// polynomial in x_d.
    std::vector<double>
    squares(const unsigned int                      degree,
            const unsigned int                      d,
            const std::vector<std::vector<double>> &coefficients)
    {
      std::vector<double> result(degree, 0.);
      for (const auto &of_component : coefficients)
        for_each_line(degree,
                      d,
                      of_component,
                      [&](const double weight, const auto &at) {
                        result[0] += weight * std::pow(at(1) - at(0), 2);
                        for (unsigned int k = 2; k <= degree; ++k)
                          result[k - 1] += weight * at(k) * at(k);
                      });
      return result;
    }

    /// Coefficient of the Legendre polynomial of degree @p n on [0, 1] of a function with coefficients @p at(k) of
    /// evaluate_lobatto(), of @p degree.
    template <typename At>
    double
    legendre(const unsigned int n, const unsigned int degree, const At &at)
    {
      const auto part = [&](const unsigned int k) {
        return k > degree ? 0. : at(k) / (2. * std::sqrt(2. * k - 1.));
      };
      const double vertices = n == 0 ? 0.5 * (at(0) + at(1)) :
                              n == 1 ? 0.5 * (at(1) - at(0)) :
                                       part(n);
      return vertices - part(n + 2);
    }

    /// Add squares of the coefficients of a function of one @p degree less.
    void
    add_squares(const unsigned int         degree,
                const unsigned int         d,
                const std::vector<double> &coefficients,
                const double               factor,
                std::vector<double>       &result)
    {
      for_each_line(
        degree - 1, d, coefficients, [&](const double weight, const auto &at) {
          for (unsigned int k = 0; k < degree; ++k)
            result[k] += weight *
                         std::pow(factor * legendre(k, degree - 1, at), 2) /
                         (2. * k + 1.);
        });
    }

    /// From the line through the logarithms.
    double
    decay_of(const std::vector<double> &squares)
    {
      const unsigned int degree = squares.size(), first = 1,
                         last = std::max(2u, degree / 2);
      const double n          = last + 1 - first;
      const double largest =
        *std::max_element(squares.begin() + first, squares.begin() + last + 1);
      if (!(largest > 0.))
        return 0.;
      double x = 0., y = 0., xx = 0., xy = 0.;
      for (unsigned int k = first; k <= last; ++k)
        {
          const double log = std::log(std::max(squares[k] / largest, 1e-30));
          x += k;
          y += log;
          xx += double(k) * k;
          xy += k * log;
        }
      return std::exp(0.5 * (n * xy - x * y) / (n * xx - x * x));
    }
  } // namespace

  double
  legendre_decay(const unsigned int                      degree,
                 const std::vector<std::vector<double>> &displacement,
                 const std::vector<double>              &pressure,
                 const double                            unit)
  {
    std::array<std::vector<double>, 3> all;
    double                             most = 0.;
    for (unsigned int d = 0; d < 3; ++d)
      {
        all[d] = squares(degree, d, displacement);
        if (!pressure.empty())
          add_squares(degree, d, pressure, unit, all[d]);
        most = std::max(most, all[d].back());
      }
    double result = 0.;
    for (const auto &of_direction : all)
      if (most > 0. && of_direction.back() >= least_part * most)
        result = std::max(result, decay_of(of_direction));
    return result;
  }

  bool
  is_smooth(const double decay)
  {
    // cells at a corner begin at 0.3, those beside them end at 0.26
    // (Fichera's, degree 3, where they are closest); of 1 / (z - x) on [-1, 1]
    // coefficients fall by z - sqrt(z^2 - 1), 0.27 for a pole at half the size
    // of the cell
    return decay < 0.28;
  }
} // namespace mortise
