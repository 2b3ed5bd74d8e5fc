// Constants in the kernel of the pressure, as of an enclosed incompressible
// body.
#pragma once

#include <mortise/operators/block_system.h>

namespace mortise
{
  /// A pressure that is constant on some bodies and zero elsewhere.
  struct Enclosure
  {
    bool         enclosed = false; ///< it is in the kernel
    SystemVector state;            ///< with the multipliers that balance it

    /// Net flux over total flux of the displacements prescribed in @p rhs; 0
    /// without flux. Collective.
    double
    flux(const SystemVector &rhs) const;
  };

  /// Is the pressure @p one in the kernel? To rounding without interfaces; with
  /// curved ties to one per cent, since their multipliers do not contain the
  /// normal field. Collective.
  Enclosure
  test_enclosure(const BlockSystem &system, const Vector &one);
} // namespace mortise
