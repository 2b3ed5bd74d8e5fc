// The shape of hexahedra for kernels, see kernel_on.h: sum factorisation.
#pragma once

#include <deal.II/base/quadrature_lib.h>

#include <mortise/base/lagrange.h>
#include <mortise/base/tensor_product.h>
#include <mortise/operators/matrix_free/kernel_on.h>
#include <mortise/operators/matrix_free/tensor_kernel.h>

#include <cmath>

namespace mortise
{
  /// n nodes and n Gauss points in each direction.
  template <typename Number, int n>
  class Hexahedra
  {
  public:
    using V                      = typename Batch<Number>::Vector;
    static constexpr int N       = n * n * n;
    static constexpr int n_nodes = N;

    explicit Hexahedra(const CellBatches<Number> &)
    {
      const dealii::QGauss<1>          points(n);
      const dealii::FullMatrix<double> values = lagrange_values(
                                         dealii::QGaussLobatto<1>(n), points),
                                       derivatives =
                                         lagrange_derivatives(points, points);
      values_at_points      = Line(values);
      from_points           = Line(transposed(values));
      derivative            = Antisymmetric(derivatives);
      derivative_transposed = Antisymmetric(transposed(derivatives));
      const dealii::QGauss<dim> all(n);
      for (unsigned int q = 0; q < N; ++q)
        root_weights[q] = std::sqrt(all.weight(q));
    }

    static constexpr unsigned int
    max_points()
    {
      return N;
    }

    template <bool affine>
    static constexpr auto
    n_points(std::bool_constant<affine>)
    {
      return std::integral_constant<int, N>();
    }

    void
    evaluate(bool, V *u, V *g) const
    {
      for (unsigned int c = 0; c < dim; ++c, u += N, g += dim * N)
        {
          apply_along<0, false, n, n, n>(values_at_points, u, u);
          apply_along<1, false, n, n, n>(values_at_points, u, u);
          apply_along<2, false, n, n, n>(values_at_points, u, u);
          apply_along<0, false, n, n, n>(derivative, u, g);
          apply_along<1, false, n, n, n>(derivative, u, g + N);
          apply_along<2, false, n, n, n>(derivative, u, g + 2 * N);
        }
    }

    void
    integrate(bool, const V *g, V *u) const
    {
      for (unsigned int c = 0; c < dim; ++c, u += N, g += dim * N)
        {
          apply_along<0, false, n, n, n>(derivative_transposed, g, u);
          apply_along<1, true, n, n, n>(derivative_transposed, g + N, u);
          apply_along<2, true, n, n, n>(derivative_transposed, g + 2 * N, u);
          apply_along<2, false, n, n, n>(from_points, u, u);
          apply_along<1, false, n, n, n>(from_points, u, u);
          apply_along<0, false, n, n, n>(from_points, u, u);
        }
    }

    /// That of the next batch is fetched.
    template <bool affine>
    inline __attribute__((always_inline)) void
    get_metric(std::bool_constant<affine>,
               const V  *metric,
               const int q,
               V (&G)[dim][dim]) const
    {
      constexpr int n9 = dim * dim;
      if constexpr (!affine)
        fetch(metric + (q + N) * n9, n9);
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int e = 0; e < dim; ++e)
          G[a][e] = affine ? metric[dim * a + e] * root_weights[q] :
                             metric[q * n9 + dim * a + e];
    }

    /// det(G) = sqrt(w |J|)^3 / |J|.
    V
    root(bool, const V (&G)[dim][dim], const int q) const
    {
      return determinant_of(G) / (root_weights[q] * root_weights[q]);
    }

    class Squares
    {
    public:
      explicit Squares(const Hexahedra &)
      {
        const dealii::QGaussLobatto<1> nodes(n);
        const dealii::QGauss<1>        points(n);
        const auto                     values = lagrange_values(nodes, points),
                   slopes = lagrange_derivatives(nodes, points);
        for (unsigned int q = 0; q < n; ++q)
          for (unsigned int k = 0; k < n; ++k)
            {
              of_line[0][q][k] = values(q, k) * values(q, k);
              of_line[1][q][k] = values(q, k) * slopes(q, k);
              of_line[2][q][k] = slopes(q, k) * slopes(q, k);
            }
      }

      void
      apply(bool, V *a, V *u) const
      {
        std::fill(u, u + dim * N, V{});
        for (unsigned int c = 0; c < dim; ++c, u += N)
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = i; j < dim; ++j, a += N)
              contract(i, j, a, u);
      }

    private:
      void
      contract(const unsigned int i, const unsigned int j, V *a, V *u) const
      {
        int stride = 1;
        for (unsigned int d = 0; d < dim; ++d, stride *= n)
          {
            const Number(&XY)[n][n] = of_line[(i == d) + (j == d)];
            for (int line = 0; line < n * n; ++line)
              {
                V *first = a + (line / stride) * stride * n + line % stride;
                V  out[n];
                for (int k = 0; k < n; ++k)
                  {
                    out[k] = V{};
                    for (int q = 0; q < n; ++q)
                      out[k] += XY[q][k] * first[q * stride];
                  }
                for (int k = 0; k < n; ++k)
                  first[k * stride] = out[k];
              }
          }
        for (int k = 0; k < N; ++k)
          u[k] += a[k];
      }

      /// N N, N N' and N' N', [point][node].
      Number of_line[3][n][n];
    };

  private:
    using Line          = LineMatrix<Number, n, n>;
    using Antisymmetric = LineMatrix<Number, n, n, true>;

    Line          values_at_points, from_points;
    Antisymmetric derivative, derivative_transposed;
    Number        root_weights[N];
  };

  /// m = n - 1 nodes and n Gauss points in each direction.
  template <typename Number, int n>
  class HexahedralPressures
  {
  public:
    using V                      = typename Batch<Number>::Vector;
    static constexpr int m       = n - 1;
    static constexpr int n_nodes = m * m * m;
    static constexpr int room    = n * n * n;

    explicit HexahedralPressures(const CellBatches<Number> &)
    {
      const dealii::FullMatrix<double> values =
        lagrange_values(dealii::QGaussLobatto<1>(m), dealii::QGauss<1>(n));
      up   = LineMatrix<Number, n, m>(values);
      down = LineMatrix<Number, m, n>(transposed(values));
      for (unsigned int q = 0; q < n; ++q)
        for (unsigned int k = 0; k < m; ++k)
          of_line[q][k] = values(q, k) * values(q, k);
    }

    void
    to_points(bool, V *at_nodes, V *at_points) const
    {
      apply_along<0, false, m, m, m>(up, at_nodes, at_points);
      apply_along<1, false, n, m, m>(up, at_points, at_nodes);
      apply_along<2, false, n, n, m>(up, at_nodes, at_points);
    }

    void
    from_points(bool, V *at_points, V *at_nodes) const
    {
      apply_along<2, false, n, n, n>(down, at_points, at_nodes);
      apply_along<1, false, n, n, m>(down, at_nodes, at_points);
      apply_along<0, false, n, m, m>(down, at_points, at_nodes);
    }

    void
    squares(bool, const V *at_points, V *at_nodes) const
    {
      std::fill_n(at_nodes, n_nodes, V{});
      for (int q = 0; q < room; ++q)
        for (int k = 0; k < n_nodes; ++k)
          at_nodes[k] += of_line[q % n][k % m] * of_line[q / n % n][k / m % m] *
                         of_line[q / n / n][k / m / m] * at_points[q];
    }

  private:
    LineMatrix<Number, n, m> up;
    LineMatrix<Number, m, n> down;
    Number                   of_line[n][m]; ///< N N, [point][node]
  };
} // namespace mortise
