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

    /// Squares of the coefficients of d/dx_d by the degree of the Legendre
    /// polynomial in x_d.
    std::vector<double>
    squares(const unsigned int                      degree,
            const unsigned int                      d,
            const std::vector<std::vector<double>> &coefficients)
    {
      const auto                        modes = cell_dof_indices(degree);
      const unsigned int                n     = degree + 1;
      const std::array<unsigned int, 3> stride{{1, n, n * n}};
      const unsigned int                e = (d + 1) % 3, f = (d + 2) % 3;
      std::vector<double>               result(degree, 0.);
      for (const auto &of_component : coefficients)
        for (unsigned int j = 0; j < n; ++j)
          for (unsigned int i = 0; i < n; ++i)
            {
              const auto at = [&](const unsigned int k) {
                return of_component[modes[k * stride[d] + i * stride[e] +
                                          j * stride[f]]];
              };
              const double weight = square(i) * square(j);
              result[0] += weight * std::pow(at(1) - at(0), 2);
              for (unsigned int k = 2; k < n; ++k)
                result[k - 1] += weight * at(k) * at(k);
            }
      return result;
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
                 const std::vector<std::vector<double>> &coefficients)
  {
    std::array<std::vector<double>, 3> all;
    double                             most = 0.;
    for (unsigned int d = 0; d < 3; ++d)
      {
        all[d] = squares(degree, d, coefficients);
        most   = std::max(most, all[d].back());
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
