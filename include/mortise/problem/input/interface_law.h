// Construction of an InterfaceLaw from parameters.
#pragma once

#include <mortise/contact/interface_law.h>
#include <mortise/problem/input/parameters.h>

namespace mortise
{
  /// May its tangential traction differ from zero?
  bool
  has_friction(const InterfaceParameters &interface);

  /// Do gaps and overlaps of the meshes count?
  bool
  has_mesh_gap(const InterfaceParameters &interface);

  /// InterfaceLaw::stiffness throws InputError where it is not positive.
  InterfaceLaw
  interface_law(const Parameters          &parameters,
                const InterfaceParameters &interface);
} // namespace mortise
