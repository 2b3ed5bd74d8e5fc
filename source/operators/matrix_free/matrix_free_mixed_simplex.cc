// The kernels behind MatrixFreeElasticity in mixed form on tetrahedra.
#include <mortise/body/elements/simplex_nodes.h>
#include <mortise/operators/matrix_free/matrix_free_simplex_kernel.h>

#include <cmath>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Pressures at the points of cells, in the basis of
    /// gradient_coefficients() where these are affine.
    template <typename Number>
    struct PressuresAtPoints
    {
      /// @p values: entry (point, node). @p scale: by point, sqrt(w |J|) over
      /// the determinant of the metric.
      PressuresAtPoints(const FullMatrix<double>  &values,
                        const std::vector<double> &scale)
        : to_points(values)
        , from_points(transposed(values))
        , scale(scale.begin(), scale.end())
      {
        FullMatrix<double> squared(values.n(), values.m());
        for (unsigned int q = 0; q < values.m(); ++q)
          for (unsigned int k = 0; k < values.n(); ++k)
            squared(k, q) = values(q, k) * values(q, k);
        squares = DenseMatrix<Number>(squared);
      }

      DenseMatrix<Number> to_points, from_points, squares;
      std::vector<Number> scale;
    };
  } // namespace

  /// Pressures of one degree less.
  template <typename Number>
  template <int degree>
  class MatrixFreeElasticity<Number>::MixedSimplexKernel
    : public MatrixFreeElasticity<Number>::template SimplexKernel<degree>,
      public MatrixFreeElasticity<Number>::MixedKernel
  {
  public:
    using Base =
      typename MatrixFreeElasticity<Number>::template SimplexKernel<degree>;
    using V                 = typename Batch<Number>::Vector;
    static constexpr int N  = Base::N;
    static constexpr int M  = Base::M; ///< also nodes of the pressure
    static constexpr int n9 = dim * dim;

    explicit MixedSimplexKernel(const CellBatches<Number> &cells)
      : Base(cells)
      , on_affine(pressure_coefficients(degree), std::vector<double>(M, 1.))
      , room((M + std::max<unsigned int>(M, cells.n_points)) *
             Batch<Number>::size)
    {
      if (!this->curved)
        return;
      const Quadrature<dim> rule = simplex_rule<Number>(degree);
      std::vector<double>   scale;
      for (unsigned int q = 0; q < rule.size(); ++q)
        scale.push_back(
          std::fabs(determinant(simplex_rule_jacobian(degree, rule.point(q)))) /
          rule.weight(q));
      on_curved = std::make_unique<PressuresAtPoints<Number>>(
        simplex_nodal_values(degree - 1, rule.get_points()), scale);
    }

    void
    add_mixed_product(const CellBatches<Number> &cells,
                      const Fields              &src,
                      const Fields              &dst) override
    {
      const auto   law             = std::get<IsotropicLaw<Number>>(cells.law);
      const Number compressibility = cells.compressibility;
      V *u = reinterpret_cast<V *>(this->scratch.data()), *g = u + dim * N;
      for (unsigned int batch = 0; batch < cells.n_batches; ++batch)
        {
          gather<N>(src.displacement, nodes_of(cells, batch), u);
          evaluate(cells, batch, u, g);
          V        *p = pressures(cells, batch, src.pressure);
          const int n = n_points(cells, batch);
          for_each_point(cells,
                         batch,
                         [&](const int q, const V(&G)[dim][dim], const V w) {
                           V h[dim][dim], s[dim][dim];
                           gradient_at(g + q, n, G, h);
                           law.tangent(Undeformed(), h, s);
                           const V weighted = w * p[q];
                           for (unsigned int c = 0; c < dim; ++c)
                             s[c][c] -= weighted;
                           set_stress(s, G, n, g + q);
                           p[q] = -w * (h[0][0] + h[1][1] + h[2][2] +
                                        compressibility * weighted);
                         });
          integrate(cells, batch, g, u);
          scatter_add<N>(u, nodes_of(cells, batch), dst.displacement);
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
          const V  *values = pressures(cells, batch, p);
          const int n      = n_points(cells, batch);
          for_each_point(cells,
                         batch,
                         [&](const int q, const V(&G)[dim][dim], const V w) {
                           const V weighted = -w * values[q];
                           for (unsigned int c = 0; c < dim; ++c)
                             for (unsigned int a = 0; a < dim; ++a)
                               g[(dim * c + a) * n + q] = weighted * G[a][c];
                         });
          integrate(cells, batch, g, u);
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
          V *values = pressures(cells, batch, p);
          multiply_by_norm(cells, batch, values);
          integrate_pressures(cells, batch, dst);
        }
    }

    void
    add_pressure_norm_diagonal(const CellBatches<Number> &cells,
                               Number                    *dst) override
    {
      V *sums = reinterpret_cast<V *>(room.data()), *values = sums + M;
      for (unsigned int batch = 0; batch < cells.n_batches; ++batch)
        {
          std::fill_n(values, n_points(cells, batch), V{} + Number(1));
          multiply_by_norm(cells, batch, values);
          at_points(cells, batch).squares.template apply<1>(values, sums);
          scatter_add<M, 1>(sums, pressure_nodes_of(cells, batch), dst);
        }
    }

  private:
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

    static int
    n_points(const CellBatches<Number> &cells, const unsigned int batch)
    {
      return batch < cells.n_affine ? M : cells.n_points;
    }

    const PressuresAtPoints<Number> &
    at_points(const CellBatches<Number> &cells, const unsigned int batch) const
    {
      return batch < cells.n_affine ? on_affine : *on_curved;
    }

    void
    evaluate(const CellBatches<Number> &cells,
             const unsigned int         batch,
             const V                   *u,
             V                         *g) const
    {
      if (batch < cells.n_affine)
        this->affine.evaluate(u, g);
      else
        this->curved->evaluate(u, g);
    }

    void
    integrate(const CellBatches<Number> &cells,
              const unsigned int         batch,
              const V                   *g,
              V                         *u) const
    {
      if (batch < cells.n_affine)
        this->affine.integrate(g, u);
      else
        this->curved->integrate(g, u);
    }

    /// At points, behind the nodes' in the room.
    V *
    pressures(const CellBatches<Number> &cells,
              const unsigned int         batch,
              const Number              *p)
    {
      V *at_nodes = reinterpret_cast<V *>(room.data()), *values = at_nodes + M;
      gather<M, 1>(p, pressure_nodes_of(cells, batch), at_nodes);
      at_points(cells, batch).to_points.template apply<1>(at_nodes, values);
      return values;
    }

    /// From where pressures() puts them.
    void
    integrate_pressures(const CellBatches<Number> &cells,
                        const unsigned int         batch,
                        Number                    *dst)
    {
      V *at_nodes = reinterpret_cast<V *>(room.data());
      at_points(cells, batch)
        .from_points.template apply<1>(at_nodes + M, at_nodes);
      scatter_add<M, 1>(at_nodes, pressure_nodes_of(cells, batch), dst);
    }

    /// visit(point, metric, sqrt(w |J|)).
    template <typename Visit>
    void
    for_each_point(const CellBatches<Number> &cells,
                   const unsigned int         batch,
                   const Visit               &visit) const
    {
      const bool is_affine = batch < cells.n_affine;
      const V   *metric = reinterpret_cast<const V *>(cells.metric_of(batch));
      const std::vector<Number> &scale = at_points(cells, batch).scale;
      V                          G[dim][dim];
      for (int q = 0; q < n_points(cells, batch); ++q)
        {
          for (unsigned int a = 0; a < dim; ++a)
            for (unsigned int e = 0; e < dim; ++e)
              G[a][e] = metric[(is_affine ? 0 : q * n9) + dim * a + e];
          // less than zero where vertices ascend the other way round
          const V det = G[0][0] * (G[1][1] * G[2][2] - G[1][2] * G[2][1]) -
                        G[0][1] * (G[1][0] * G[2][2] - G[1][2] * G[2][0]) +
                        G[0][2] * (G[1][0] * G[2][1] - G[1][1] * G[2][0]);
          visit(q, G, scale[q] * (det < 0 ? -det : det));
        }
    }

    void
    multiply_by_norm(const CellBatches<Number> &cells,
                     const unsigned int         batch,
                     V                         *p) const
    {
      const Number factor = cells.pressure_norm;
      for_each_point(cells,
                     batch,
                     [&](const int q, const V(&)[dim][dim], const V w) {
                       p[q] *= factor * w * w;
                     });
    }

    PressuresAtPoints<Number>                  on_affine;
    std::unique_ptr<PressuresAtPoints<Number>> on_curved;
    AlignedVector<Number> room; ///< pressures at nodes, then at points
  };

  template <typename Number>
  std::unique_ptr<typename MatrixFreeElasticity<Number>::Kernel>
  MatrixFreeElasticity<Number>::make_mixed_simplex_kernel(
    const CellBatches<Number> &cells)
  {
    switch (cells.degree)
      {
        case 2:
          return std::make_unique<MixedSimplexKernel<2>>(cells);
        case 3:
          return std::make_unique<MixedSimplexKernel<3>>(cells);
        case 4:
          return std::make_unique<MixedSimplexKernel<4>>(cells);
        case 5:
          return std::make_unique<MixedSimplexKernel<5>>(cells);
        case 6:
          return std::make_unique<MixedSimplexKernel<6>>(cells);
        case 7:
          return std::make_unique<MixedSimplexKernel<7>>(cells);
        default:
          AssertThrow(cells.degree == 8, ExcInternalError());
          return std::make_unique<MixedSimplexKernel<8>>(cells);
      }
  }

  template std::unique_ptr<MatrixFreeElasticity<double>::Kernel>
  MatrixFreeElasticity<double>::make_mixed_simplex_kernel(
    const CellBatches<double> &);
} // namespace mortise
