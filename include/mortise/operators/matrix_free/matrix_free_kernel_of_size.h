// The kernels behind MatrixFreeElasticity, by number of nodes per direction;
// only sources of kernels include this.
#pragma once

#include <deal.II/base/quadrature_lib.h>

#include <mortise/base/lagrange.h>
#include <mortise/base/tensor_product.h>
#include <mortise/operators/matrix_free/matrix_free_kernel.h>
#include <mortise/operators/matrix_free/node_access.h>
#include <mortise/operators/matrix_free/point_kernel.h>
#include <mortise/operators/matrix_free/tensor_kernel.h>

#include <cmath>

namespace mortise
{
  /// n nodes and n Gauss points in each direction.
  template <typename Number>
  template <int n>
  class MatrixFreeElasticity<Number>::KernelOfSize
    : public MatrixFreeElasticity<Number>::Kernel
  {
  public:
    using V                 = typename Batch<Number>::Vector;
    static constexpr int N  = n * n * n;
    static constexpr int n9 = dim * dim;

    KernelOfSize()
      : scratch((dim + n9) * N * Batch<Number>::size)
    {
      const dealii::QGaussLobatto<1>   nodes(n);
      const dealii::QGauss<1>          points(n);
      const dealii::FullMatrix<double> values = lagrange_values(nodes, points),
                                       derivatives =
                                         lagrange_derivatives(points, points);
      to_points             = Line(values);
      from_points           = Line(transposed(values));
      derivative            = Antisymmetric(derivatives);
      derivative_transposed = Antisymmetric(transposed(derivatives));
      const dealii::FullMatrix<double> slopes =
        lagrange_derivatives(nodes, points);
      for (unsigned int q = 0; q < n; ++q)
        for (unsigned int k = 0; k < n; ++k)
          {
            squares[0][q][k] = values(q, k) * values(q, k);
            squares[1][q][k] = values(q, k) * slopes(q, k);
            squares[2][q][k] = slopes(q, k) * slopes(q, k);
          }
      const dealii::QGauss<dim> all(n);
      for (unsigned int q = 0; q < N; ++q)
        root_weights[q] = std::sqrt(all.weight(q));
    }

    void
    add_product(const CellBatches<Number> &cells,
                const Number              *src,
                Number                    *dst) override
    {
      V *u = reinterpret_cast<V *>(scratch.data()), *g = u + dim * N;
      for (unsigned int batch = 0; batch < cells.n_batches; ++batch)
        {
          const unsigned int *nodes =
            &cells.nodes[std::size_t(batch) * N * Batch<Number>::size];
          const V *metric = reinterpret_cast<const V *>(cells.metric_of(batch));
          gather<N>(src, nodes, u);
          evaluate(u, g);
          std::visit(
            [&](const auto &law) {
              if (batch < cells.n_affine)
                at_points<true>(metric, law, g);
              else
                at_points<false>(metric, law, g);
            },
            cells.law);
          integrate(g, u);
          scatter_add<N>(u, nodes, dst);
        }
    }

    void
    add_diagonal(const CellBatches<Number> &cells, Number *dst) override
    {
      V *diagonal = reinterpret_cast<V *>(scratch.data()),
        *a        = diagonal + dim * N;
      for (unsigned int batch = 0; batch < cells.n_batches; ++batch)
        {
          std::fill(diagonal, diagonal + dim * N, V{});
          for (unsigned int c = 0; c < dim; ++c)
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int j = i; j < dim; ++j)
                {
                  coefficients(cells, batch, c, i, j, a);
                  contract(i, j, a, diagonal + c * N);
                }
          scatter_add<N>(
            diagonal,
            &cells.nodes[std::size_t(batch) * N * Batch<Number>::size],
            dst);
        }
    }

  protected:
    /// Gradients with respect to xi at all points, g[3 c + a], from values at
    /// nodes, which are overwritten.
    void
    evaluate(V *u, V *g) const
    {
      for (unsigned int c = 0; c < dim; ++c, u += N, g += dim * N)
        {
          apply_along<0, false, n, n, n>(to_points, u, u);
          apply_along<1, false, n, n, n>(to_points, u, u);
          apply_along<2, false, n, n, n>(to_points, u, u);
          apply_along<0, false, n, n, n>(derivative, u, g);
          apply_along<1, false, n, n, n>(derivative, u, g + N);
          apply_along<2, false, n, n, n>(derivative, u, g + 2 * N);
        }
    }

    void
    integrate(const V *g, V *u) const
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

    /// The metric at point @p q, weights included: sqrt(w |J|) dxi_a/dx_e as
    /// G[a][e]. That of the next batch is fetched.
    template <bool affine>
    void
    metric_at(const V *metric, const int q, V (&G)[dim][dim]) const
    {
      if constexpr (!affine)
        fetch_metric(metric + (q + N) * n9);
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int e = 0; e < dim; ++e)
          G[a][e] = affine ? metric[dim * a + e] * root_weights[q] :
                             metric[q * n9 + dim * a + e];
    }

  private:
    using Line          = LineMatrix<Number, n, n>;
    using Antisymmetric = LineMatrix<Number, n, n, true>;

    /// Gradients of u to what is tested with gradients of v, weights included.
    template <bool affine, typename Law>
    void
    at_points(const V *metric, const Law law, V *g) const
    {
      for (int q = 0; q < N; ++q)
        {
          V G[dim][dim], h[dim][dim], s[dim][dim];
          metric_at<affine>(metric, q, G);
          gradient_at(g + q, N, G, h);
          law.tangent(Undeformed(), h, s);
          set_stress(s, G, N, g + q);
        }
    }

    /// diagonal_coefficient() at all points.
    void
    coefficients(const CellBatches<Number> &cells,
                 const unsigned int         batch,
                 const unsigned int         c,
                 const unsigned int         i,
                 const unsigned int         j,
                 V                         *result) const
    {
      const V   *metric = reinterpret_cast<const V *>(cells.metric_of(batch));
      const bool affine = batch < cells.n_affine;
      std::visit(
        [&](const auto &law) {
          for (int q = 0; q < N; ++q)
            result[q] =
              (affine ? root_weights[q] * root_weights[q] : Number(1)) *
              diagonal_coefficient(
                law, c, i, j, affine ? metric : metric + q * n9);
        },
        cells.law);
    }

    /// result_k += sum_q a_q dN_k/dxi_i dN_k/dxi_j; @p a is overwritten.
    void
    contract(const unsigned int i, const unsigned int j, V *a, V *result) const
    {
      int stride = 1;
      for (unsigned int d = 0; d < dim; ++d, stride *= n)
        {
          const Number(&XY)[n][n] = squares[(i == d) + (j == d)];
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
        result[k] += a[k];
    }

    Line          to_points, from_points;
    Antisymmetric derivative, derivative_transposed;
    /// N N, N N' and N' N' of one direction, [point][node].
    Number squares[3][n][n];

  protected:
    Number                        root_weights[N];
    dealii::AlignedVector<Number> scratch;
  };
} // namespace mortise
