// Loops cut into pieces that fit the registers of the processor.
#pragma once

#include <type_traits>

namespace mortise
{
  /// visit(first, number) for 0, ..., @p n - 1, by pieces of @p size and what
  /// is left one by one; the number is a constant of the compiler.
  template <unsigned int size, typename Visit>
  inline void
  for_each_register_block(const unsigned int n, const Visit &visit)
  {
    unsigned int i = 0;
    for (; i + size <= n; i += size)
      visit(i, std::integral_constant<unsigned int, size>());
    for (; i < n; ++i)
      visit(i, std::integral_constant<unsigned int, 1>());
  }
} // namespace mortise
