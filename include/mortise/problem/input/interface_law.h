// What the law of an interface means for its coupling.
#pragma once

#include <mortise/mortar/coupling.h>
#include <mortise/problem/input/parameters.h>

#include <functional>

namespace mortise
{
  /// What @p interface is as a spring; null where it is none. The function throws InputError for a
  /// stiffness that is not positive somewhere.
  std::function<Stiffness(const dealii::Point<dim> &)>
  spring_stiffness(const Parameters          &parameters,
                   const InterfaceParameters &interface);

  /// Along the normal alone, or all of them?
  TiedDirections
  tied_directions(const Parameters          &parameters,
                  const InterfaceParameters &interface);
} // namespace mortise
