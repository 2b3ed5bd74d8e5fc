// Rigid motion of bodies along their loads until gaps close, if an active set
// leaves them free.
#pragma once

#include <mortise/problem/contact/preloads.h>
#include <mortise/problem/scene/discretisation.h>

#include <vector>

namespace mortise
{
  /// Move bodies with free rigid motions with the @p active multipliers, by
  /// owned one, from @p x along their loads and @p preloads until gaps close;
  /// the multipliers there become active, and the motion continues along free
  /// directions. Motions without work of the loads or without a gap in their
  /// way remain free. Collective.
  std::vector<bool>
  close_gaps_rigidly(const Discretisation &discretisation,
                     const Preloads       &preloads,
                     const SceneLoad      &load,
                     const SystemVector   &x,
                     std::vector<bool>     active);
} // namespace mortise
