#include <deal.II/base/quadrature_lib.h>

#include <mortise/body/elements/simplex_quadrature.h>

#include <algorithm>
#include <vector>

namespace mortise
{
  using namespace dealii;

  template <int dim>
  Quadrature<dim>
  collapsed_quadrature(const unsigned int degree)
  {
    // x_d = y_d prod_(e > d) (1 - y_e): the Jacobian is
    // prod_d (1 - y_d)^d, which raises the degree in direction d by d.
    std::vector<Point<dim>> points(1);
    std::vector<double>     weights(1, 1.);
    for (unsigned int d = 0; d < dim; ++d)
      {
        // n points are exact up to degree 2 n - 1
        const QGauss<1>         rule((degree + d) / 2 + 1);
        std::vector<Point<dim>> more_points;
        std::vector<double>     more_weights;
        for (unsigned int q = 0; q < rule.size(); ++q)
          for (unsigned int i = 0; i < points.size(); ++i)
            {
              const double y = rule.point(q)[0];
              Point<dim>   x(points[i] * (1. - y));
              x[d] = y;
              more_points.push_back(x);
              more_weights.push_back(weights[i] * rule.weight(q) *
                                     std::pow(1. - y, d));
            }
        points.swap(more_points);
        weights.swap(more_weights);
      }
    return Quadrature<dim>(points, weights);
  }

  template <int dim>
  Quadrature<dim>
  simplex_quadrature(const unsigned int degree)
  {
    // of order 2 n - 1 (odd) or 2 n. The rule of degree 9 on tetrahedra has
    // points 2e-9 from the vertices, where singular functions are huge.
    const bool         odd = degree % 2 == 1 && !(dim == 3 && degree == 9);
    const unsigned int n   = std::max(1u, (degree + 1) / 2);
    if (n <= (dim == 2 ? 7u : 5u))
      return QWitherdenVincentSimplex<dim>(n, odd || degree == 0);
    return collapsed_quadrature<dim>(degree);
  }

  template <int dim>
  Quadrature<dim>
  gauss_quadrature(const FiniteElement<3> &element, const unsigned int n)
  {
    if (element.reference_cell() == ReferenceCells::Hexahedron)
      return QGauss<dim>(n);
    return simplex_quadrature<dim>(2 * n - 1);
  }

  template Quadrature<2>
  gauss_quadrature(const FiniteElement<3> &, unsigned int);
  template Quadrature<3>
  gauss_quadrature(const FiniteElement<3> &, unsigned int);
  template Quadrature<2>
  collapsed_quadrature(unsigned int);
  template Quadrature<3>
  collapsed_quadrature(unsigned int);
  template Quadrature<2>
  simplex_quadrature(unsigned int);
  template Quadrature<3>
  simplex_quadrature(unsigned int);
} // namespace mortise
