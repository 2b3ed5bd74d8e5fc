// Numbers that the processor computes together.
#pragma once

#include <mortise/base/register_width.h>

#include <cstdint>
#include <cstring>
#include <type_traits>

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

  /// The upper half of a number in single precision (bfloat16), with eight
  /// binary digits.
  using UpperHalf = std::uint16_t;

  /// To the nearest.
  inline UpperHalf
  upper_half(const float x)
  {
    std::uint32_t bits;
    std::memcpy(&bits, &x, sizeof bits);
    return (bits + 0x7fff + (bits >> 16 & 1)) >> 16;
  }

  inline double
  from_upper_half(const UpperHalf x)
  {
    const std::uint32_t bits = std::uint32_t(x) << 16;
    float               result;
    std::memcpy(&result, &bits, sizeof result);
    return result;
  }

  /// @p x, numbers as Stored, as Number.
  template <typename Number, typename Stored>
  inline __attribute__((always_inline)) typename Batch<Number>::Vector
  unpacked(const typename BatchAs<Number, Stored>::Vector &x)
  {
    using V = typename Batch<Number>::Vector;
    if constexpr (std::is_same_v<Stored, UpperHalf>)
      return (V)(__builtin_convertvector(
                   x, typename BatchAs<Number, std::uint32_t>::Vector)
                 << 16);
    else
      return __builtin_convertvector(x, V);
  }

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
