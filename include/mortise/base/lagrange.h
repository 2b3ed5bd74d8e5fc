// Tables of Lagrange polynomials on [0, 1]. It knows no element.
#pragma once

#include <deal.II/base/quadrature.h>

#include <deal.II/lac/full_matrix.h>

namespace mortise
{
  /// Values at @p to of the Lagrange polynomials on @p from: entry (to, from).
  dealii::FullMatrix<double>
  lagrange_values(const dealii::Quadrature<1> &from,
                  const dealii::Quadrature<1> &to);

  /// Derivatives.
  dealii::FullMatrix<double>
  lagrange_derivatives(const dealii::Quadrature<1> &from,
                       const dealii::Quadrature<1> &to);
} // namespace mortise
