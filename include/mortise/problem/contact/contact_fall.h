// Contact that a set of multipliers leaves free: where bodies fall to under
// their loads. It never solves for displacements.
#pragma once

#include <mortise/problem/contact/preloads.h>
#include <mortise/problem/scene/discretisation.h>

#include <vector>

namespace mortise
{
  /// Bodies that @p active multipliers, by owned one, do not hold fall from @p x along their
  /// loads and @p preloads, rigid, until gaps close, whose multipliers are then active, and on along what is
  /// still free. What closed first need not press in the end: sets that follow
  /// tell. The result leaves motions free where no load goes along them, or
  /// nothing is in the way. Collective.
  std::vector<bool>
  fall(const Discretisation &discretisation,
       const Preloads       &preloads,
       const SceneLoad      &load,
       const SystemVector   &x,
       std::vector<bool>     active);
} // namespace mortise
