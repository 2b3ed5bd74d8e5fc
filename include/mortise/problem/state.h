// Where a run stands.
#pragma once

#include <mortise/operators/block_system.h>

namespace mortise
{
  /// The solution of the last step that was accepted. Without a size: unloaded.
  struct State
  {
    double       time = 0.;
    SystemVector solution; ///< without what is prescribed
  };
} // namespace mortise
