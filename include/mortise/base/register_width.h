// Width of the registers of the target processor. Wider vectors of the compiler
// stay in memory (GCC 12), at a tenth of the speed.
#pragma once

namespace mortise
{
  /// Bytes of a vector register.
#if defined(__AVX512F__)
  constexpr unsigned int register_width = 64;
#elif defined(__AVX__)
  constexpr unsigned int register_width = 32;
#else
  constexpr unsigned int register_width = 16;
#endif

#ifdef MORTISE_CORE_REGISTER_WIDTH
  // what programs that use the installed library are compiled with
  static_assert(register_width == MORTISE_CORE_REGISTER_WIDTH,
                "libmortise_core was compiled for other processors: "
                "compile with the same -march, without it if it has none");
#endif

  /// Rows of a matrix whose sums for three components stay in registers, with
  /// what they are made of: there are 32 registers or 16.
  constexpr unsigned int n_register_rows = register_width == 64 ? 4 : 3;
} // namespace mortise
