// The kernels behind MatrixFreeElasticity on tetrahedra, by degree: dense
// matrices of the reference cell between nodes and points, or sum factorisation
// where curved cells have many points. Only sources of kernels include this.
#pragma once

#include <mortise/operators/matrix_free/collapsed_kernel.h>
#include <mortise/operators/matrix_free/dense_kernel.h>
#include <mortise/operators/matrix_free/matrix_free_kernel.h>
#include <mortise/operators/matrix_free/node_access.h>
#include <mortise/operators/matrix_free/point_kernel.h>

#include <algorithm>
#include <memory>

namespace mortise
{
  /// Gradients of the nodal functions, row (axis, coefficient), as
  /// coefficients in an orthonormal basis of the polynomials of degree - 1 on
  /// the reference cell, whose sums of products are integrals: fewer than the
  /// points of a rule.
  const dealii::FullMatrix<double> &
  gradient_coefficients(unsigned int degree);

  /// Derivatives of the nodal functions along the axes of simplex_rule(): row
  /// (axis, point).
  template <typename Number>
  const dealii::FullMatrix<double> &
  gradients_on_curved(unsigned int degree);

  /// Of the nodal functions of degree - 1, in the basis of
  /// gradient_coefficients(degree): entry (coefficient, node).
  dealii::FullMatrix<double>
  pressure_coefficients(unsigned int degree);

  template <typename Number>
  class DenseGradients
  {
  public:
    using V = typename Batch<Number>::Vector;

    /// @p gradients: row (axis, point).
    explicit DenseGradients(const dealii::FullMatrix<double> &gradients)
      : to_points(gradients)
      , from_points(transposed(gradients))
    {}

    void
    evaluate(const V *u, V *g) const
    {
      to_points.apply(u, g);
    }

    void
    integrate(const V *g, V *u) const
    {
      from_points.apply(g, u);
    }

  private:
    DenseMatrix<Number> to_points, from_points;
  };

  template <typename Number>
  template <int degree>
  class MatrixFreeElasticity<Number>::SimplexKernel
    : public MatrixFreeElasticity<Number>::Kernel
  {
  public:
    using V                = typename Batch<Number>::Vector;
    static constexpr int N = (degree + 1) * (degree + 2) * (degree + 3) / 6;
    /// What an affine cell has in place of points.
    static constexpr int M  = degree * (degree + 1) * (degree + 2) / 6;
    static constexpr int n9 = dim * dim;

    explicit SimplexKernel(const CellBatches<Number> &cells)
      : affine(gradient_coefficients(degree))
      , scratch((dim * N + n9 * std::max<unsigned int>(M, cells.n_points)) *
                Batch<Number>::size)
    {
      if (cells.n_batches > cells.n_affine)
        {
          if constexpr (degree < sum_factorised_from)
            curved =
              std::make_unique<Curved>(gradients_on_curved<Number>(degree));
          else
            curved = std::make_unique<Curved>();
        }
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
          if (batch < cells.n_affine)
            {
              affine.evaluate(u, g);
              std::visit(
                [=](const auto &law) {
                  on_all_points<true>(law, metric, M, g);
                },
                cells.law);
              affine.integrate(g, u);
            }
          else
            {
              curved->evaluate(u, g);
              std::visit(
                [=, n = cells.n_points](const auto &law) {
                  on_all_points<false>(law, metric, n, g);
                },
                cells.law);
              curved->integrate(g, u);
            }
          scatter_add<N>(u, nodes, dst);
        }
    }

    void
    add_diagonal(const CellBatches<Number> &cells, Number *dst) override
    {
      V *diagonal = reinterpret_cast<V *>(scratch.data());
      dealii::AlignedVector<Number> room(
        std::size_t(dim * n_pairs) * std::max<unsigned int>(M, cells.n_points) *
        Batch<Number>::size);
      V                  *a = reinterpret_cast<V *>(room.data());
      DenseMatrix<Number> on_affine, on_curved;
      if (cells.n_affine > 0)
        on_affine = DenseMatrix<Number>(pairs(gradient_coefficients(degree)));
      if (curved)
        on_curved =
          DenseMatrix<Number>(pairs(gradients_on_curved<Number>(degree)));
      for (unsigned int batch = 0; batch < cells.n_batches; ++batch)
        {
          const bool is_affine = batch < cells.n_affine;
          coefficients(cells, batch, is_affine ? M : cells.n_points, a);
          (is_affine ? on_affine : on_curved).apply(a, diagonal);
          scatter_add<N>(
            diagonal,
            &cells.nodes[std::size_t(batch) * N * Batch<Number>::size],
            dst);
        }
    }

  protected:
    using Curved = std::conditional_t<(degree < sum_factorised_from),
                                      DenseGradients<Number>,
                                      CollapsedKernel<Number, degree>>;

    DenseGradients<Number>        affine;
    std::unique_ptr<Curved>       curved; ///< where there are such cells
    dealii::AlignedVector<Number> scratch;

  private:
    static constexpr unsigned int n_pairs = 6; ///< of axes

    /// Gradients of u to what is tested with gradients of v, @p g as
    /// [c][a][point].
    template <bool is_affine, typename Law>
    static void
    on_all_points(const Law law, const V *metric, const int n_points, V *g)
    {
      V G[dim][dim], h[dim][dim], s[dim][dim];
      for (int q = 0; q < n_points; ++q)
        {
          if (q == 0 || !is_affine)
            for (unsigned int a = 0; a < dim; ++a)
              for (unsigned int e = 0; e < dim; ++e)
                G[a][e] = metric[q * n9 + dim * a + e];
          if (!is_affine)
            fetch_metric(metric + (q + n_points) * n9);
          gradient_at(g + q, n_points, G, h);
          law.tangent(Undeformed(), h, s);
          set_stress(s, G, n_points, g + q);
        }
    }

    /// diagonal_coefficient() as [c][(i, j)][point].
    static void
    coefficients(const CellBatches<Number> &cells,
                 const unsigned int         batch,
                 const unsigned int         n_points,
                 V                         *result)
    {
      const V   *metric = reinterpret_cast<const V *>(cells.metric_of(batch));
      const bool is_affine = batch < cells.n_affine;
      std::visit(
        [&](const auto &law) {
          for (unsigned int c = 0; c < dim; ++c)
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int j = i; j < dim; ++j, result += n_points)
                for (unsigned int q = 0; q < n_points; ++q)
                  result[q] = diagonal_coefficient(
                    law, c, i, j, is_affine ? metric : metric + q * n9);
        },
        cells.law);
    }

    /// dN_k/dxi_i dN_k/dxi_j: row k, column ((i, j), point).
    static dealii::FullMatrix<double>
    pairs(const dealii::FullMatrix<double> &gradients)
    {
      const unsigned int         n = gradients.m() / dim;
      dealii::FullMatrix<double> result(N, n_pairs * n);
      unsigned int               column = 0;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = i; j < dim; ++j)
          for (unsigned int q = 0; q < n; ++q, ++column)
            for (int k = 0; k < N; ++k)
              result(k, column) =
                gradients(i * n + q, k) * gradients(j * n + q, k);
      return result;
    }
  };
} // namespace mortise
