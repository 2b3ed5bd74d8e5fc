// The kernels behind MatrixFreeElasticity in mixed form, by number of nodes of
// the displacement per direction; only sources of kernels include this.
#pragma once

#include <mortise/operators/matrix_free/matrix_free_kernel_of_size.h>

namespace mortise
{
  /// n nodes of the displacement, n - 1 of the pressure and n Gauss points in
  /// each direction.
  template <typename Number>
  template <int n>
  class MatrixFreeElasticity<Number>::MixedKernelOfSize
    : public MatrixFreeElasticity<Number>::template KernelOfSize<n>,
      public MatrixFreeElasticity<Number>::MixedKernel
  {
  public:
    using V                = typename Batch<Number>::Vector;
    static constexpr int m = n - 1;
    static constexpr int N = n * n * n;
    static constexpr int M = m * m * m;

    MixedKernelOfSize()
      : pressure_scratch(2 * N * Batch<Number>::size)
    {
      const dealii::FullMatrix<double> values =
        lagrange_values(dealii::QGaussLobatto<1>(m), dealii::QGauss<1>(n));
      to_points   = ToPoints(values);
      from_points = FromPoints(transposed(values));
      for (unsigned int q = 0; q < n; ++q)
        for (unsigned int k = 0; k < m; ++k)
          squares[q][k] = values(q, k) * values(q, k);
    }

    void
    add_mixed_product(const CellBatches<Number> &cells,
                      const Fields              &src,
                      const Fields              &dst) override
    {
      V *u = reinterpret_cast<V *>(this->scratch.data()), *g = u + dim * N;
      for (unsigned int batch = 0; batch < cells.n_batches; ++batch)
        {
          const unsigned int *nodes = nodes_of(cells, batch);
          gather<N>(src.displacement, nodes, u);
          this->evaluate(u, g);
          V *p = pressures_at_points(cells, batch, src.pressure);
          if (batch < cells.n_affine)
            at_points<true>(cells, batch, g, p);
          else
            at_points<false>(cells, batch, g, p);
          this->integrate(g, u);
          scatter_add<N>(u, nodes, dst.displacement);
          integrate_pressures(cells, batch, dst.pressure);
        }
    }

    void
    add_pressure_force(const CellBatches<Number> &cells,
                       const Number              *p,
                       Number                    *dst) override
    {
      V *u = reinterpret_cast<V *>(this->scratch.data()), *g = u + dim * N;
      for (unsigned int batch = 0; batch < cells.n_batches; ++batch)
        {
          const V *values = pressures_at_points(cells, batch, p);
          if (batch < cells.n_affine)
            force_at_points<true>(cells, batch, values, g);
          else
            force_at_points<false>(cells, batch, values, g);
          this->integrate(g, u);
          scatter_add<N>(u, nodes_of(cells, batch), dst);
        }
    }

    void
    add_pressure_norm(const CellBatches<Number> &cells,
                      const Number              *p,
                      Number                    *dst) override
    {
      for (unsigned int batch = 0; batch < cells.n_batches; ++batch)
        {
          V *values = pressures_at_points(cells, batch, p);
          multiply_by_norm(cells, batch, values);
          integrate_pressures(cells, batch, dst);
        }
    }

    void
    add_pressure_norm_diagonal(const CellBatches<Number> &cells,
                               Number                    *dst) override
    {
      V *values = reinterpret_cast<V *>(pressure_scratch.data());
      for (unsigned int batch = 0; batch < cells.n_batches; ++batch)
        {
          std::fill(values, values + N, V{} + Number(1));
          multiply_by_norm(cells, batch, values);
          V *sums = values + N;
          std::fill(sums, sums + M, V{});
          for (int q = 0; q < N; ++q)
            for (int k = 0; k < M; ++k)
              sums[k] += squares[q % n][k % m] * squares[q / n % n][k / m % m] *
                         squares[q / n / n][k / m / m] * values[q];
          scatter_add<M, 1>(sums, pressure_nodes_of(cells, batch), dst);
        }
    }

  private:
    using ToPoints   = LineMatrix<Number, n, m>;
    using FromPoints = LineMatrix<Number, m, n>;

    static const unsigned int *
    nodes_of(const CellBatches<Number> &cells, const unsigned int batch)
    {
      return &cells.nodes[std::size_t(batch) * N * Batch<Number>::size];
    }

    static const unsigned int *
    pressure_nodes_of(const CellBatches<Number> &cells,
                      const unsigned int         batch)
    {
      return &cells
                .pressure_nodes[std::size_t(batch) * M * Batch<Number>::size];
    }

    /// In the first half of the scratch.
    V *
    pressures_at_points(const CellBatches<Number> &cells,
                        const unsigned int         batch,
                        const Number              *p)
    {
      V *a = reinterpret_cast<V *>(pressure_scratch.data()), *b = a + N;
      gather<M, 1>(p, pressure_nodes_of(cells, batch), b);
      apply_along<0, false, m, m, m>(to_points, b, a);
      apply_along<1, false, n, m, m>(to_points, a, b);
      apply_along<2, false, n, n, m>(to_points, b, a);
      return a;
    }

    /// From the first half of the scratch.
    void
    integrate_pressures(const CellBatches<Number> &cells,
                        const unsigned int         batch,
                        Number                    *dst)
    {
      V *a = reinterpret_cast<V *>(pressure_scratch.data()), *b = a + N;
      apply_along<2, false, n, n, n>(from_points, a, b);
      apply_along<1, false, n, n, m>(from_points, b, a);
      apply_along<0, false, n, m, m>(from_points, a, b);
      scatter_add<M, 1>(b, pressure_nodes_of(cells, batch), dst);
    }

    /// sqrt(w |J|) at point @p q: det(G) = sqrt(w |J|)^3 / |J|.
    V
    root(const V (&G)[dim][dim], const int q) const
    {
      const V det = G[0][0] * (G[1][1] * G[2][2] - G[1][2] * G[2][1]) -
                    G[0][1] * (G[1][0] * G[2][2] - G[1][2] * G[2][0]) +
                    G[0][2] * (G[1][0] * G[2][1] - G[1][1] * G[2][0]);
      return det / (this->root_weights[q] * this->root_weights[q]);
    }

    /// Gradients of u and pressures to what is tested with those of v and
    /// pressures, weights included.
    template <bool affine>
    void
    at_points(const CellBatches<Number> &cells,
              const unsigned int         batch,
              V                         *g,
              V                         *p) const
    {
      const V     *metric = reinterpret_cast<const V *>(cells.metric_of(batch));
      const auto   law    = std::get<IsotropicLaw<Number>>(cells.law);
      const Number compressibility = cells.compressibility;
      for (int q = 0; q < N; ++q)
        {
          V G[dim][dim], h[dim][dim], s[dim][dim];
          this->template metric_at<affine>(metric, q, G);
          gradient_at(g + q, N, G, h);
          law.tangent(Undeformed(), h, s);
          const V w = root(G, q), weighted = w * p[q];
          for (unsigned int c = 0; c < dim; ++c)
            s[c][c] -= weighted;
          set_stress(s, G, N, g + q);
          p[q] =
            -w * (h[0][0] + h[1][1] + h[2][2] + compressibility * weighted);
        }
    }

    template <bool affine>
    void
    force_at_points(const CellBatches<Number> &cells,
                    const unsigned int         batch,
                    const V                   *p,
                    V                         *g) const
    {
      const V *metric = reinterpret_cast<const V *>(cells.metric_of(batch));
      for (int q = 0; q < N; ++q)
        {
          V G[dim][dim];
          this->template metric_at<affine>(metric, q, G);
          const V weighted = -root(G, q) * p[q];
          for (unsigned int c = 0; c < dim; ++c)
            for (unsigned int a = 0; a < dim; ++a)
              g[(dim * c + a) * N + q] = weighted * G[a][c];
        }
    }

    void
    multiply_by_norm(const CellBatches<Number> &cells,
                     const unsigned int         batch,
                     V                         *p) const
    {
      const V     *metric = reinterpret_cast<const V *>(cells.metric_of(batch));
      const Number factor = cells.pressure_norm;
      for (int q = 0; q < N; ++q)
        {
          V G[dim][dim];
          if (batch < cells.n_affine)
            this->template metric_at<true>(metric, q, G);
          else
            this->template metric_at<false>(metric, q, G);
          const V w = root(G, q);
          p[q] *= factor * w * w;
        }
    }

    ToPoints                      to_points;
    FromPoints                    from_points;
    Number                        squares[n][m];
    dealii::AlignedVector<Number> pressure_scratch;
  };
} // namespace mortise
