// Are the loads of a scene, and then its results, numbers that a run can stand
// for? It never looks at how they were computed.
#pragma once

#include <mortise/operators/block_system.h>
#include <mortise/output/summary.h>

#include <string>

namespace mortise
{
  /// Throw InputError if the largest entry of the right hand side is neither 0
  /// nor between smallest_number and largest_number: its square could not be
  /// represented, and a residual relative to it would be 0/0. Collective.
  void
  check_loads(const BlockSystem &system);

  /// Multiply the right hand side by @p factor.
  void
  scale_loads(BlockSystem &system, double factor);

  /// The power of two that brings the largest entry of the right hand side
  /// between 1/2 and 1; 1 if all are zero. Collective.
  double
  load_scale(const BlockSystem &system);

  /// The first result of @p step that is not finite, as "name = value"; empty if
  /// all are.
  std::string
  first_not_finite(const StepSummary &step);
} // namespace mortise
