// Construction of an InterfaceLaw from parameters.
#pragma once

#include <mortise/contact/interface_law.h>
#include <mortise/problem/input/parameters.h>

namespace mortise
{
  /// InterfaceLaw::stiffness throws InputError where it is not positive.
  InterfaceLaw
  interface_law(const Parameters          &parameters,
                const InterfaceParameters &interface);
} // namespace mortise
