// Finds constants that may be added to the pressure without any effect.
#pragma once

#include <mortise/operators/block_system.h>

namespace mortise
{
  /// What is known of a pressure that is constant on some bodies and zero
  /// elsewhere.
  struct Enclosure
  {
    bool         enclosed = false; ///< the pressure moves nothing
    SystemVector state;            ///< it, with the multipliers that balance it

    /// Net over total flux of what @p rhs prescribes; 0 where nothing flows. Collective.
    double
    flux(const SystemVector &rhs) const;
  };

  /// Is the pressure @p one without effect on displacements? To rounding where no interface is
  /// near; where curved interfaces tie the bodies, to one per cent, since
  /// normals are no multipliers there. Collective.
  Enclosure
  test_enclosure(const BlockSystem &system, const Vector &one);
} // namespace mortise
