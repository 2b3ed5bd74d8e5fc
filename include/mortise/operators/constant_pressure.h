// The pressure that is one on a body and zero on all others, and its integrals.
#pragma once

#include <mortise/operators/assembled/pressure_scatter.h>
#include <mortise/operators/block_system.h>

namespace mortise
{
  /// Of @p body in mixed form. Collective.
  Vector
  constant_pressure(const Body        &body,
                    const SceneField  &pressure,
                    const BlockSystem &system);

  /// int_body q for all pressures q; @p one: constant_pressure() of the body.
  /// Collective.
  Vector
  pressure_integrals(const Body        &body,
                     const SceneField  &pressure,
                     const BlockSystem &system,
                     const Vector      &one);
} // namespace mortise
