// Proves that the quadrature rules of triangles and tetrahedra integrate all
// monomials up to their degree, with positive weights and points inside, none
// close to a vertex.

#include <mortise/body/elements/simplex_quadrature.h>
#include <verdict.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>

using namespace dealii;

/// Largest error over all monomials of degree up to @p degree, relative to
/// their integrals i! j! k! / (i + j + k + dim)!; infinite if a weight is not
/// positive or a point lies outside or next to a vertex, where solutions may be
/// singular: nearer than 0.1 / (degree + 1)^2, far less than what the collapsed
/// rules have.
template <int dim>
double
largest_error(const Quadrature<dim> &rule, const unsigned int degree)
{
  double error = 0.;
  for (unsigned int q = 0; q < rule.size(); ++q)
    {
      double rest = 1., largest = 0.;
      for (unsigned int d = 0; d < dim; ++d)
        {
          rest -= rule.point(q)[d];
          largest = std::max(largest, rule.point(q)[d]);
          if (rule.point(q)[d] < 0.)
            return std::numeric_limits<double>::infinity();
        }
      largest = std::max(largest, rest);
      if (rule.weight(q) <= 0. || rest < 0. ||
          1. - largest < 0.1 / ((degree + 1) * (degree + 1)))
        return std::numeric_limits<double>::infinity();
    }
  for (unsigned int i = 0; i <= degree; ++i)
    for (unsigned int j = 0; i + j <= degree; ++j)
      for (unsigned int k = 0; i + j + k <= (dim == 3 ? degree : i + j); ++k)
        {
          double sum = 0.;
          for (unsigned int q = 0; q < rule.size(); ++q)
            sum += rule.weight(q) * std::pow(rule.point(q)[0], i) *
                   std::pow(rule.point(q)[1], j) *
                   std::pow(rule.point(q)[dim - 1], k);
          const double exact =
            std::exp(std::lgamma(i + 1.) + std::lgamma(j + 1.) +
                     std::lgamma(k + 1.) - std::lgamma(i + j + k + dim + 1.));
          error = std::max(error, std::abs(sum / exact - 1.));
        }
  return error;
}

template <int dim>
void
check(const unsigned int max_degree)
{
  const std::string shape = dim == 2 ? "triangle" : "tetrahedron";
  for (unsigned int degree = 0; degree <= max_degree; ++degree)
    {
      const auto         rule      = mortise::simplex_quadrature<dim>(degree);
      const auto         collapsed = mortise::collapsed_quadrature<dim>(degree);
      const double       errors[2] = {largest_error(rule, degree),
                                      largest_error(collapsed, degree)};
      const unsigned int sizes[2]  = {rule.size(), collapsed.size()};
      for (const unsigned int which : {0, 1})
        {
          const std::string what = shape + ", degree " +
                                   std::to_string(degree) + ", " +
                                   (which == 0 ? "best" : "collapsed") + ", " +
                                   std::to_string(sizes[which]) + " points";
          verdict(what + ": exact, 1e-12", errors[which], 1e-12);
        }
      if (sizes[0] > sizes[1])
        verdict(false, "the collapsed rule has more points", sizes[1]);
    }
}

int
main()
{
  // twice the highest degree and the same again for curved cells
  check<2>(32);
  check<3>(24);
}
