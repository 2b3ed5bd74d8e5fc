// Interface of the kernels of MatrixFreeElasticity for any degree; only sources
// of kernels include this.
#pragma once

#include <mortise/operators/matrix_free/matrix_free_elasticity.h>

#include <type_traits>

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

    /// Of linear laws, unless the kernel has others.
    virtual LeastJacobian
    add_residual(const CellBatches<Number> &cells,
                 const Fields              &src,
                 const StateOfPoints &,
                 double *,
                 const Fields &dst)
    {
      add_mixed_product(cells, src, dst);
      return {};
    }

    virtual void
    linearise(CellBatches<Number> &,
              const Fields &,
              const Fields &,
              const StateOfPoints &)
    {}

    virtual std::vector<Moduli>
    average_moduli(const CellBatches<Number> &, bool)
    {
      return {};
    }

    /// Of displacements alone, unless the kernel has pressures.
    virtual void
    add_mixed_product(const CellBatches<Number> &cells,
                      const Fields              &src,
                      const Fields              &dst)
    {
      add_product(cells, src.displacement, dst.displacement);
    }

    virtual void
    add_pressure_force(const CellBatches<Number> &, const Number *, Number *)
    {}

    virtual void
    add_pressure_norm(const CellBatches<Number> &, const Number *, Number *)
    {}

    virtual void
    add_pressure_norm_diagonal(const CellBatches<Number> &, Number *)
    {}
  };

  /// make(degree), the degree as a constant from @p first to max_degree.
  template <int first, typename Make>
  auto
  with_degree(const unsigned int degree, const Make &make)
  {
    if constexpr (first < max_degree)
      if (degree != first)
        return with_degree<first + 1>(degree, make);
    AssertThrow(degree == first, dealii::ExcInternalError());
    return make(std::integral_constant<int, first>());
  }
} // namespace mortise
