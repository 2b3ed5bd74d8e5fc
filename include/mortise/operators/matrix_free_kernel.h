// What MatrixFreeElasticity asks of its kernels, of any degree; only sources of
// kernels include this.
#pragma once

#include <mortise/operators/matrix_free_elasticity.h>

namespace mortise
{
  template <typename Number>
  class MatrixFreeElasticity<Number>::Kernel
  {
  public:
    virtual ~Kernel() = default;
    virtual void
    add_product(const CellBatches<Number> &cells,
                const Number              *src,
                Number                    *dst) = 0;
    virtual void
    add_diagonal(const CellBatches<Number> &cells, Number *dst) = 0;
  };

  template <typename Number>
  class MatrixFreeElasticity<Number>::MixedKernel
  {
  public:
    virtual ~MixedKernel() = default;
    virtual void
    add_mixed_product(const CellBatches<Number> &cells,
                      const Fields              &src,
                      const Fields              &dst) = 0;
    virtual void
    add_pressure_force(const CellBatches<Number> &cells,
                       const Number              *p,
                       Number                    *dst) = 0;
    virtual void
    add_pressure_norm(const CellBatches<Number> &cells,
                      const Number              *p,
                      Number                    *dst) = 0;
    virtual void
    add_pressure_norm_diagonal(const CellBatches<Number> &cells,
                               Number                    *dst) = 0;
  };
} // namespace mortise
