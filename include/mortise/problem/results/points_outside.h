// Check that the points of Output/Points lie in their bodies.
#pragma once

#include <mortise/operators/scene_system.h>
#include <mortise/problem/input/run_context.h>

namespace mortise
{
  /// Warn of points outside; throw InputError for that of the Quantity. Bodies
  /// have their spaces. Collective.
  void
  check_points(const RunContext &run, const Bodies &bodies);
} // namespace mortise
