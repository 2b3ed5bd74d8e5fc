// The pressure that is one on a body and zero on all others, and its integrals.
// It never looks at displacements.
#pragma once

#include <mortise/operators/block_system.h>
#include <mortise/operators/pressure_scatter.h>

namespace mortise
{
  struct ConstantPressure
  {
    Vector one;
    Vector mass; ///< int_body q for all pressures q
  };

  /// Of @p body in mixed form. Collective.
  ConstantPressure
  constant_pressure(const Body        &body,
                    const SceneField  &pressure,
                    const BlockSystem &system);
} // namespace mortise
