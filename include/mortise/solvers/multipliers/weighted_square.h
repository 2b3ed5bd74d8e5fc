// C = B T B^T by dense blocks.
#pragma once

#include <mortise/operators/levels/multigrid_level.h>
#include <mortise/solvers/factorisation/rows_by_node.h>
#include <mortise/solvers/multipliers/rows_by_entity.h>

namespace mortise
{
  /// B T B^T, computed once for components with the same entries. @p coupling:
  /// B. @p weights: T, diagonal, by owned displacement. Collective.
  RowsByNode
  weighted_square(const RowsByEntity        &coupling,
                  const LevelVector<double> &weights);

  /// R C R^T for the C of rows by component, each row a node. @p frames: R, see
  /// BlockSystem. @p left_out: rows of R, owned, that get a diagonal of one
  /// alone; empty: none. Collective.
  RowsByNode
  in_frames(const RowsByNode        &C,
            const SparseMatrix      &frames,
            const std::vector<bool> &left_out = {});
} // namespace mortise
