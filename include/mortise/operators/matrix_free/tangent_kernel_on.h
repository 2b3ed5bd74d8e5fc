// Products with tangents that are kept at points, for any shape of cells, see
// kernel_on.h. Only sources of kernels include this.
#pragma once

#include <mortise/operators/matrix_free/mixed_kernel_on.h>

namespace mortise
{
  /// Products with tangents that are kept at points. @p Base: KernelOn or
  /// MixedKernelOn.
  template <typename Number>
  template <typename Base>
  class MatrixFreeElasticity<Number>::TangentKernelOn : public Base
  {
  public:
    using V = typename Batch<Number>::Vector;
    using Base::Base;

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
      with_form(cells.nonlinear->form(), [&](const auto form) {
        using Stored         = StoredTangent<Number, form()>;
        constexpr unsigned n = n_stored<Stored>(form());
        const auto        *tangent =
          in_batches<Number>(cells.template tangent_of<form()>()) +
          std::size_t(batch) * cells.n_points * n;
        this->template at_points_of<false>(
          tangent_metric(cells, batch), [=](const auto &at) {
            fetch(tangent + (at.q + at.n) * n, n);
            visit(TangentAt<Number, form(), Stored>{tangent + at.q * n}, at);
          });
      });
    }

  private:
    static const Number *
    tangent_metric(const CellBatches<Number> &cells, const unsigned int batch)
    {
      const std::size_t size =
        std::size_t(cells.n_points) * dim * dim * Batch<Number>::size;
      return cells.deformed_metric.empty() ?
               cells.metric_of(batch) :
               cells.deformed_metric.data() + batch * size;
    }
  };
} // namespace mortise
