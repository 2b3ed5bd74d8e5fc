// C = B T B^T by dense blocks.
#pragma once

#include <mortise/operators/levels/nodal_level.h>
#include <mortise/solvers/factorisation/nodal_matrix.h>
#include <mortise/solvers/multipliers/coupling_rows.h>

namespace mortise
{
  /// B T B^T, computed once for components with the same entries. @p coupling:
  /// B. @p weights: T, diagonal, by owned displacement. Collective.
  NodalMatrix
  weighted_square(const CouplingRows        &coupling,
                  const LevelVector<double> &weights);

  /// R C R^T for the C of rows by component, each row a node. @p frames: R, see
  /// BlockSystem. Collective.
  NodalMatrix
  in_frames(const NodalMatrix &C, const SparseMatrix &frames);
} // namespace mortise
