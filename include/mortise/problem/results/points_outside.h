// Are the points of Output/Points in their bodies?
#pragma once

#include <mortise/operators/scene_system.h>
#include <mortise/problem/input/run_context.h>

namespace mortise
{
  /// Warn of those that are not; throw InputError if one is what the Quantity
  /// is of. Bodies of points have their spaces. Collective.
  void
  check_points(const RunContext &run, const Bodies &bodies);
} // namespace mortise
