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
      this->template at_points_of<false>(cells, batch, [=](const auto &at) {
        visit(TangentLaw<Number>{moduli +
                                 at.q * NonlinearLaw<Number>::n_moduli},
              at);
      });
    }

    void
    add_residual(const CellBatches<Number> &cells,
                 const Number              *u,
                 const Number              *before,
                 Number                    *after,
                 Number                    *dst) override
    {
      const unsigned int n_history = cells.nonlinear->n_history();
      for (unsigned int batch = 0; batch < cells.n_batches; ++batch)
        {
          V *g = this->gradients(cells, batch, u);
          at_states(cells,
                    batch,
                    before,
                    [&](const auto &at, const auto &state) {
                      V s[dim][dim];
                      cells.nonlinear->stress(state.h,
                                              state.before,
                                              reinterpret_cast<V *>(after) +
                                                state.number * n_history,
                                              s);
                      for (auto &row : s)
                        for (V &entry : row)
                          entry *= state.root;
                      set_stress(s, at.G, at.n, g + at.q);
                    });
          this->add_forces(cells, batch, dst);
        }
    }

    void
    linearise(CellBatches<Number> &cells,
              const Number        *u,
              const Number        *before) override
    {
      V *moduli = reinterpret_cast<V *>(cells.moduli.data());
      for (unsigned int batch = 0; batch < cells.n_batches; ++batch)
        {
          this->gradients(cells, batch, u);
          at_states(cells, batch, before, [&](const auto &, const auto &state) {
            cells.nonlinear->tangent(state.h,
                                     state.before,
                                     moduli + state.number *
                                                NonlinearLaw<Number>::n_moduli);
          });
        }
    }

  private:
    struct State
    {
      std::size_t number; ///< among the points of all batches
      V           root;   ///< sqrt(w |J|)
      V           h[dim][dim];
      const V    *before;
    };

    /// visit(point, state) from where gradients are.
    template <typename Visit>
    void
    at_states(const CellBatches<Number> &cells,
              const unsigned int         batch,
              const Number              *before,
              const Visit               &visit)
    {
      const V           *g         = this->gradients();
      const unsigned int n_history = cells.nonlinear->n_history();
      this->template at_points_of<false>(cells, batch, [&](const auto &at) {
        State state{std::size_t(batch) * at.n + at.q, at.root(), {}, nullptr};
        state.before =
          reinterpret_cast<const V *>(before) + state.number * n_history;
        gradient_at(g + at.q, at.n, at.G, state.h);
        // lanes without a cell have no metric
        const V divisor = state.root > 0 ? state.root : V{} + Number(1);
        for (auto &row : state.h)
          for (V &entry : row)
            entry /= divisor;
        visit(at, state);
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
