// The volume of a body as its mesh has it.
#pragma once

#include <mortise/body/body.h>

namespace mortise
{
  /// Exact for the mapping of the cells; a length cubed. Collective.
  double
  body_volume(const Body &body);
} // namespace mortise
