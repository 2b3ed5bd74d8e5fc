#include <deal.II/base/polynomial.h>

#include <mortise/base/lagrange.h>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    std::vector<Polynomials::Polynomial<double>>
    lagrange(const Quadrature<1> &nodes)
    {
      return Polynomials::generate_complete_Lagrange_basis(nodes.get_points());
    }
  } // namespace

  FullMatrix<double>
  lagrange_values(const Quadrature<1> &from, const Quadrature<1> &to)
  {
    const auto         basis = lagrange(from);
    FullMatrix<double> values(to.size(), from.size());
    for (unsigned int q = 0; q < to.size(); ++q)
      for (unsigned int i = 0; i < from.size(); ++i)
        values(q, i) = basis[i].value(to.point(q)[0]);
    return values;
  }

  FullMatrix<double>
  lagrange_derivatives(const Quadrature<1> &from, const Quadrature<1> &to)
  {
    const auto          basis = lagrange(from);
    FullMatrix<double>  derivatives(to.size(), from.size());
    std::vector<double> value_and_slope(2);
    for (unsigned int q = 0; q < to.size(); ++q)
      for (unsigned int i = 0; i < from.size(); ++i)
        {
          basis[i].value(to.point(q)[0], value_and_slope);
          derivatives(q, i) = value_and_slope[1];
        }
    return derivatives;
  }
} // namespace mortise
