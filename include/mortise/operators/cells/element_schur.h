// The Schur complement C + G K^{-1} G^T of the pressures of one cell some of
// whose displacements are prescribed. Sources: Kraus (2006), "Algebraic
// multilevel preconditioning of finite element matrices using local Schur
// complements"; Neytcheva (2011).
#pragma once

#include <deal.II/lac/full_matrix.h>

#include <vector>

namespace mortise
{
  /// The part of its mass matrix that a cell keeps in P beside its Schur
  /// complement, so that P is regular even where no displacement is free.
  constexpr double regular_part = 1e-3;

  /// G K^{-1} G^T of one cell, by the displacements @p free alone. The sum of
  /// these over the cells bounds the Schur complement of all from above, and is
  /// close to it where a mass matrix is not: at boundaries that are
  /// constrained. Rigid motions, which the pressure does not feel, may be among
  /// the free ones.
  /// @p divergence: rows by pressure; as many columns as the symmetric
  /// @p stiffness has rows and columns.
  dealii::FullMatrix<double>
  element_schur(const dealii::FullMatrix<double> &stiffness,
                const dealii::FullMatrix<double> &divergence,
                const std::vector<unsigned int>  &free);
} // namespace mortise
