// See bernstein.h.
#include "bernstein.h"

#include <mortise/body/elements/legendre_basis.h>
#include <mortise/mortar/nodal_block.h>

#include <cmath>
#include <utility>

namespace mortise
{
  using namespace dealii;

  double
  binomial_term(const unsigned int n,
                const unsigned int k,
                const double       a,
                const double       b)
  {
    double result = 1.;
    for (unsigned int i = 0; i < k; ++i)
      result *= a * (n - i) / (i + 1.);
    return result * std::pow(b, n - k);
  }

  const LineTransform &
  line_transform(const unsigned int degree)
  {
    static std::map<unsigned int, LineTransform> known;
    LineTransform                               &result = known[degree];
    const unsigned int                           n      = degree + 1;
    if (result.to_modes.m() > 0)
      return result;
    FullMatrix<double> modes(n, n), bernstein(n, n), inverse(n, n);
    for (unsigned int i = 0; i < n; ++i)
      {
        const double x = double(i) / degree;
        evaluate_lobatto(degree, x, &modes(i, 0));
        for (unsigned int j = 0; j < n; ++j)
          bernstein(i, j) = binomial_term(degree, j, x, 1. - x);
      }
    result.to_bernstein.reinit(n, n);
    result.to_modes.reinit(n, n);
    inverse.invert(bernstein);
    inverse.mmult(result.to_bernstein, modes);
    inverse.invert(modes);
    inverse.mmult(result.to_modes, bernstein);
    return result;
  }

  void
  elevate(std::vector<Combination> &coefficients, const unsigned int degree)
  {
    while (coefficients.size() <= degree)
      {
        const unsigned int       n = coefficients.size();
        std::vector<Combination> higher(n + 1);
        for (unsigned int i = 0; i <= n; ++i)
          {
            if (i > 0)
              add(higher[i], double(i) / n, coefficients[i - 1]);
            if (i < n)
              add(higher[i], 1. - double(i) / n, coefficients[i]);
          }
        coefficients = std::move(higher);
      }
  }

  BernsteinLattice::BernsteinLattice(const FaceShape                    shape,
                                     const std::array<unsigned int, 2> &degree)
    : shape(shape)
    , degree(degree)
  {
    for (unsigned int j = 0; j <= degree[1]; ++j)
      for (unsigned int i = 0; i + (is_triangle() ? j : 0) <= degree[0]; ++i)
        {
          numbers[{{i, j}}] = multi_indices.size();
          multi_indices.push_back(
            {{i, j, is_triangle() ? degree[0] - i - j : 0}});
        }
  }
  unsigned int
  BernsteinLattice::on_edge(const TraceBasis  &basis,
                            const unsigned int e,
                            const unsigned int k) const
  {
    if (!is_triangle())
      {
        const unsigned int side = (e % 2) * degree[1 - e / 2];
        return e / 2 == 0 ? numbers.at({{k, side}}) : numbers.at({{side, k}});
      }
    MultiIndex barycentric{};
    const auto ends      = basis.edge_vertices(e);
    barycentric[ends[0]] = degree[0] - k;
    barycentric[ends[1]] = k;
    return of_barycentric(barycentric);
  }
  bool
  BernsteinLattice::is_inside(const MultiIndex &multi_index) const
  {
    return multi_index[0] > 0 && multi_index[1] > 0 &&
           (is_triangle() ?
              multi_index[2] > 0 :
              multi_index[0] < degree[0] && multi_index[1] < degree[1]);
  }
  Combination
  BernsteinLattice::mean_of_ruled(const MultiIndex               &multi_index,
                                  const std::vector<Combination> &all) const
  {
    Combination result;
    if (!is_triangle())
      for (unsigned int a = 0; a < 2; ++a)
        {
          MultiIndex low = multi_index, high = multi_index;
          low[a]         = 0;
          high[a]        = degree[a];
          const double t = double(multi_index[a]) / degree[a];
          add(result, (1. - t) / 2., all[numbers.at({{low[0], low[1]}})]);
          add(result, t / 2., all[numbers.at({{high[0], high[1]}})]);
        }
    else
      for (unsigned int v = 0; v < 3; ++v)
        {
          // barycentric, vertex 0 first
          const MultiIndex b{{multi_index[2], multi_index[0], multi_index[1]}};
          const unsigned int u = (v + 1) % 3, w = (v + 2) % 3,
                             sum = b[u] + b[w];
          MultiIndex at_u{}, at_w{};
          at_u[v] = at_w[v] = b[v];
          at_u[u] = at_w[w] = sum;
          add(result, b[u] / (3. * sum), all[of_barycentric(at_u)]);
          add(result, b[w] / (3. * sum), all[of_barycentric(at_w)]);
        }
    return result;
  }
  double
  BernsteinLattice::value(const MultiIndex &multi_index,
                          const Point<2>   &x) const
  {
    if (!is_triangle())
      return binomial_term(degree[0], multi_index[0], x[0], 1. - x[0]) *
             binomial_term(degree[1], multi_index[1], x[1], 1. - x[1]);
    return binomial_term(degree[0], multi_index[0], x[0], 1.) *
           binomial_term(degree[0] - multi_index[0],
                         multi_index[1],
                         x[1],
                         1. - x[0] - x[1]);
  }
  unsigned int
  BernsteinLattice::of_barycentric(const MultiIndex &barycentric) const
  {
    return numbers.at({{barycentric[1], barycentric[2]}});
  }
  FullMatrix<double>
  BernsteinLattice::at_nodes(const TraceBasis &basis) const
  {
    const auto         nodes = face_nodes(basis.shape, basis.degree);
    FullMatrix<double> result(nodes.size(), multi_indices.size());
    for (unsigned int k = 0; k < nodes.size(); ++k)
      for (unsigned int i = 0; i < multi_indices.size(); ++i)
        result(k, i) = value(multi_indices[i], nodes[k]);
    return result;
  }
} // namespace mortise
