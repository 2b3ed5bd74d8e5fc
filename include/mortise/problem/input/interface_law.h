// The law of an interface, from its parameters.
#pragma once

#include <mortise/contact/interface_law.h>
#include <mortise/problem/input/parameters.h>

namespace mortise
{
  /// The stiffness of a spring throws InputError where it is not positive.
  InterfaceLaw
  interface_law(const Parameters          &parameters,
                const InterfaceParameters &interface);
} // namespace mortise
