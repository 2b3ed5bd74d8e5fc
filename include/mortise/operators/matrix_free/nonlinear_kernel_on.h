// The kernels behind MatrixFreeElasticity for laws that are not linear, for any
// shape of cells, see kernel_on.h. Only sources of kernels include this.
#pragma once

#include <mortise/operators/matrix_free/kernel_on.h>

namespace mortise
{
  template <typename Number>
  template <typename Shape>
  class MatrixFreeElasticity<Number>::NonlinearKernelOn : public KernelOn<Shape>
  {
  public:
    using V = typename Batch<Number>::Vector;
    using KernelOn<Shape>::KernelOn;

    void
    add_product(const CellBatches<Number> &cells,
                const Number              *src,
                Number                    *dst) override
    {
      this->multiply(*this, cells, src, dst);
    }

    void
    add_diagonal(const CellBatches<Number> &cells, Number *dst) override
    {
      this->sum_diagonal(*this, cells, dst);
    }

    /// As that of KernelOn, the law being the tangent at the point.
    template <typename Visit>
    void
    at_laws(const CellBatches<Number> &cells,
            const unsigned int         batch,
            const Visit               &visit) const
    {
      const V *moduli =
        reinterpret_cast<const V *>(cells.moduli.data()) +
        std::size_t(batch) * cells.n_points * NonlinearLaw<Number>::n_moduli;
      this->at_points(
        std::false_type(),
        cells,
        batch,
        [=](const auto affine, const auto n, const int q, auto &G) {
          const TangentLaw<Number> law{moduli +
                                       q * NonlinearLaw<Number>::n_moduli};
          visit(law, affine, n, q, G);
        });
    }

    void
    add_residual(const CellBatches<Number> &cells,
                 const Number              *u,
                 const Number              *before,
                 Number                    *after,
                 Number                    *dst) override
    {
      const NonlinearLaw<Number> &law       = *cells.nonlinear;
      const unsigned int          n_history = law.n_history();
      for (unsigned int batch = 0; batch < cells.n_batches; ++batch)
        {
          V *g = this->gradients(cells, batch, u);
          at_states(cells,
                    batch,
                    [&](const std::size_t point,
                        const V(&h)[dim][dim],
                        const V     w,
                        const auto  n,
                        const int   q,
                        const auto &G) {
                      V s[dim][dim];
                      law.stress(h,
                                 reinterpret_cast<const V *>(before) +
                                   point * n_history,
                                 reinterpret_cast<V *>(after) +
                                   point * n_history,
                                 s);
                      for (auto &row : s)
                        for (V &entry : row)
                          entry *= w;
                      set_stress(s, G, n, g + q);
                    });
          this->add_forces(cells, batch, dst);
        }
    }

    void
    linearise(CellBatches<Number> &cells,
              const Number        *u,
              const Number        *before) override
    {
      const NonlinearLaw<Number> &law       = *cells.nonlinear;
      const unsigned int          n_history = law.n_history();
      V *moduli = reinterpret_cast<V *>(cells.moduli.data());
      for (unsigned int batch = 0; batch < cells.n_batches; ++batch)
        {
          this->gradients(cells, batch, u);
          at_states(cells,
                    batch,
                    [&](const std::size_t point,
                        const V(&h)[dim][dim],
                        const V &,
                        const auto &,
                        const int,
                        const auto &) {
                      law.tangent(h,
                                  reinterpret_cast<const V *>(before) +
                                    point * n_history,
                                  moduli + point * law.n_moduli);
                    });
        }
    }

  private:
    /// visit(point among all, h, sqrt(w |J|), number of points, point, metric)
    /// from where gradients are.
    template <typename Visit>
    void
    at_states(const CellBatches<Number> &cells,
              const unsigned int         batch,
              const Visit               &visit)
    {
      const V *g = this->gradients();
      this->at_points(
        std::false_type(),
        cells,
        batch,
        [&](const auto affine, const auto n, const int q, auto &G) {
          V h[dim][dim];
          gradient_at(g + q, n, G, h);
          const V w = this->shape.root(affine, G, q);
          // lanes without a cell have no metric
          const V divisor = w > 0 ? w : V{} + Number(1);
          for (auto &row : h)
            for (V &entry : row)
              entry /= divisor;
          visit(std::size_t(batch) * n + q, h, w, n, q, G);
        });
    }
  };

  template <typename Number>
  template <typename Shape>
  std::unique_ptr<typename MatrixFreeElasticity<Number>::Kernel>
  MatrixFreeElasticity<Number>::make_kernel_on(const CellBatches<Number> &cells)
  {
    if constexpr (std::is_same_v<Number, double>)
      if (cells.nonlinear)
        return std::make_unique<NonlinearKernelOn<Shape>>(cells);
    return std::make_unique<KernelOn<Shape>>(cells);
  }
} // namespace mortise
