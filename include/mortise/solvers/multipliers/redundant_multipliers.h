// Detection of linearly dependent (redundant) constraints.
#pragma once

#include <mortise/mortar/coupling_matrix.h>

#include <vector>

namespace mortise
{
  /// Global indices of the multipliers without which the others are
  /// independent: the vanishing pivots of C = B diag(K)^{-1} B^T, scaled by the
  /// roots of @p scale. @p inverse_diagonal: of K. @p compliance: of springs,
  /// whose diagonal is added to C, or of size 0. The same on all ranks.
  /// Collective.
  std::vector<dealii::types::global_dof_index>
  find_redundant_multipliers(const CouplingMatrix &coupling,
                             const Vector         &inverse_diagonal,
                             const Vector         &scale,
                             const SparseMatrix   &compliance);
} // namespace mortise
