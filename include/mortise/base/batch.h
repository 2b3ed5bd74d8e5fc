// Numbers that the processor computes together.
#pragma once

#include <mortise/base/register_width.h>

namespace mortise
{
  /// As many as fill a register.
  template <typename Number>
  struct Batch
  {
    static constexpr unsigned int size = register_width / sizeof(Number);
    typedef Number                Vector
      __attribute__((vector_size(register_width), may_alias));
  };
} // namespace mortise
