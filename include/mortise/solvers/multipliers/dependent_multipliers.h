// Multipliers whose constraint follows from those of others, so that the
// system has no single solution. It never drops one.
#pragma once

#include <mortise/mortar/coupling_matrix.h>

#include <vector>

namespace mortise
{
  /// Global indices of so many multipliers that the rest is independent:
  /// those whose pivots vanish when C = B diag(K)^{-1} B^T is factorised, its
  /// rows
  /// and columns scaled by the roots of @p scale. @p inverse_diagonal: of K. @p compliance: of springs,
  /// whose diagonal stands beside that of C, or of size 0. The same on all
  /// ranks. Collective.
  std::vector<dealii::types::global_dof_index>
  find_dependent_multipliers(const CouplingMatrix &coupling,
                             const Vector         &inverse_diagonal,
                             const Vector         &scale,
                             const SparseMatrix   &compliance);
} // namespace mortise
