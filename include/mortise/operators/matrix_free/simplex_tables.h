// Reference matrices of tetrahedra, of any degree.
#pragma once

#include <deal.II/base/quadrature.h>

#include <deal.II/lac/full_matrix.h>

#include <mortise/base/types.h>

namespace mortise
{
  /// Least degree on tetrahedra at which sum factorisation beats dense matrices
  /// on curved cells; where deal.II's symmetric rules end.
  constexpr unsigned int sum_factorised_from = 6;

  /// The points of curved tetrahedra: exact up to twice the degree, see
  /// doc/measurements/tuning.md; in single precision, which serves
  /// preconditioners alone, one degree less where sum factorisation does not
  /// need more, still exact on affine cells.
  template <typename Number>
  dealii::Quadrature<dim>
  simplex_rule(unsigned int degree);

  /// The coordinates that the kernel of simplex_rule() differentiates along:
  /// dx_b/dy_a as [a][b] at the point @p x of the reference tetrahedron, y being
  /// the collapsed ones (CollapsedKernel) or x themselves.
  dealii::Tensor<2, dim>
  simplex_rule_jacobian(unsigned int degree, const dealii::Point<dim> &x);

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
} // namespace mortise
