// What presses first in a scene with contact: what presses with lower degrees,
// which is known after a fraction of the time, since sets are as many as there
// are nodes between the first guess and the edge of the contact.
#pragma once

#include <mortise/contact/multiplier_places.h>
#include <mortise/problem/input/run_context.h>
#include <mortise/problem/scene/scene_spaces.h>

#include <optional>

namespace mortise
{
  /// For the loads at @p time, from degree one (bodies in mixed form: two) up to half of what the
  /// parameters say. Nothing without contact, for few nodes, where degrees are
  /// lowest anyway, and where no contact is found (what is wrong then is told
  /// by the scene itself). Changes the spaces of
  /// @p bodies. Collective.
  std::optional<ActivePlaces>
  contact_start(const RunContext &run, double time, Bodies &bodies);
} // namespace mortise
