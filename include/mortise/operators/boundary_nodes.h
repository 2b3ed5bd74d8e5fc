// The nodes of a level on a boundary of a body, and where they are.
#pragma once

#include <mortise/operators/levels/multigrid_level.h>

namespace mortise
{
  /// 1 for the components of the nodes of @p level whose functions do not
  /// vanish on @p boundary of @p body, else 0; their sum is one there. Without
  /// ghost values. Collective.
  LevelVector<double>
  boundary_nodes(const MultigridLevel      &level,
                 const Body                &body,
                 dealii::types::boundary_id boundary);

  /// Places (lengths, undeformed) of the nodes that @p wanted, as boundary_nodes() gives it, has in
  /// @p body, zero elsewhere. Without ghost values. Collective.
  LevelVector<double>
  node_positions(const MultigridLevel      &level,
                 const Body                &body,
                 const LevelVector<double> &wanted);
} // namespace mortise
