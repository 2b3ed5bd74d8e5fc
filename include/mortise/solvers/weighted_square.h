// C = B T B^T by dense blocks. It never factorises.
#pragma once

#include <Epetra_CrsMatrix.h>
#include <mortise/operators/nodal_level.h>
#include <mortise/solvers/node_rows.h>

namespace mortise
{
  /// B T B^T where multipliers of a component move displacements of this
  /// component only; computed once for all components of a node where their
  /// rows are the same. @p coupling: B, displacements numbered by node, the
  /// three components one after the other; multipliers by entity of the mesh,
  /// in it by component. @p weights: T, diagonal, by owned displacement.
  /// Collective.
  NodeRows
  weighted_square(const Epetra_CrsMatrix    &coupling,
                  const LevelVector<double> &weights);
} // namespace mortise
