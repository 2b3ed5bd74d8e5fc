// C = B T B^T by dense blocks.
#pragma once

#include <mortise/operators/nodal_level.h>
#include <mortise/solvers/coupling_rows.h>
#include <mortise/solvers/node_rows.h>

namespace mortise
{
  /// B T B^T; what all components share is computed once. @p coupling: B, by
  /// node. @p weights: T, diagonal, by owned displacement. Collective.
  NodeRows
  weighted_square(const CouplingRows        &coupling,
                  const LevelVector<double> &weights);
} // namespace mortise
