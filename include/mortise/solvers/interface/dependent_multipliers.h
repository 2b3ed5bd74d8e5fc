// Multipliers whose constraint follows from those of others, so that the
// system has no single solution. It never drops one.
#pragma once

#include <mortise/operators/block_system.h>

#include <vector>

namespace mortise
{
  /// Global indices of so many multipliers that the rest is independent:
  /// those whose pivots vanish when C = B diag(K)^{-1} B^T is factorised, all
  /// diagonal entries scaled to one. The same on all ranks. Collective.
  std::vector<dealii::types::global_dof_index>
  find_dependent_multipliers(const BlockSystem &system);
} // namespace mortise
