// Finds constants that may be added to the pressure without any effect. It
// never solves the system.
#pragma once

#include <mortise/operators/block_system.h>

namespace mortise
{
  /// How little of the force of a constant pressure is left when multipliers
  /// have taken what they can.
  struct EnclosureTest
  {
    bool   enclosed = false;
    double flux     = 0.; ///< net over total flux of what is prescribed
  };

  /// Is the pressure @p one, constant on some bodies and zero elsewhere, without
  /// effect on displacements? To rounding where no interface is near; where
  /// curved interfaces tie the bodies, to one per cent, since normals are no
  /// multipliers there. Collective.
  EnclosureTest
  test_enclosure(const BlockSystem &system, const Vector &one);
} // namespace mortise
