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

  /// Those of Batch<Number> in the precision of Stored.
  template <typename Number, typename Stored>
  struct BatchAs
  {
    typedef Stored Vector
      __attribute__((vector_size(Batch<Number>::size * sizeof(Stored)),
                     may_alias));
  };

  /// @p numbers as batches of as many as Batch<Number> has.
  template <typename Number, typename Stored>
  inline typename BatchAs<Number, Stored>::Vector *
  in_batches(Stored *numbers)
  {
    return reinterpret_cast<typename BatchAs<Number, Stored>::Vector *>(
      numbers);
  }

  template <typename Number, typename Stored>
  inline const typename BatchAs<Number, Stored>::Vector *
  in_batches(const Stored *numbers)
  {
    return reinterpret_cast<const typename BatchAs<Number, Stored>::Vector *>(
      numbers);
  }
} // namespace mortise
