// What MatrixFreeElasticity asks of its kernels, of any degree; only sources of
// kernels include this.
#pragma once

#include <mortise/operators/matrix_free/matrix_free_elasticity.h>

namespace mortise
{
  /// Least degree on tetrahedra at which sum factorisation beats dense matrices
  /// on curved cells; where deal.II's symmetric rules end.
  constexpr unsigned int sum_factorised_from = 6;

  /// The points of curved tetrahedra: exact up to twice the degree, so that of
  /// stiffness_quadrature(); in single precision, which serves preconditioners
  /// alone, one degree less where sum factorisation does not need more, still
  /// exact on affine cells.
  template <typename Number>
  dealii::Quadrature<dim>
  simplex_rule(unsigned int degree);

  /// The coordinates that the kernel of simplex_rule() differentiates along:
  /// dx_b/dy_a as [a][b] at the point @p x of the reference tetrahedron, y being
  /// the collapsed ones (CollapsedKernel) or x themselves.
  dealii::Tensor<2, dim>
  simplex_rule_jacobian(unsigned int degree, const dealii::Point<dim> &x);

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
