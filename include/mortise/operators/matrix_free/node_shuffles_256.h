// The components of one node of several cells in registers of 32 bytes, see
// node_access.h.
#pragma once

#include <immintrin.h>
#include <mortise/operators/matrix_free/tensor_kernel.h>

namespace mortise
{
  typedef double FourDoubles __attribute__((vector_size(32)));
  typedef float  FourFloats __attribute__((vector_size(16)));

  inline FourDoubles
  load_components(const double *from)
  {
    return (FourDoubles)_mm256_maskload_pd(from,
                                           _mm256_set_epi64x(0, -1, -1, -1));
  }

  inline FourFloats
  load_components(const float *from)
  {
    return (FourFloats)_mm_maskload_ps(from, _mm_set_epi32(0, -1, -1, -1));
  }

  // Processors of AMD before Zen 4 take dozens of operations for a masked
  // store.

  inline void
  add_components(const FourDoubles &values, double *to)
  {
    const __m256d sum = (__m256d)(load_components(to) + values);
    _mm_storeu_pd(to, _mm256_castpd256_pd128(sum));
    _mm_store_sd(to + 2, _mm256_extractf128_pd(sum, 1));
  }

  inline void
  add_components(const FourFloats &values, float *to)
  {
    const __m128 sum = (__m128)(load_components(to) + values);
    _mm_storel_pi((__m64 *)to, sum);
    _mm_store_ss(to + 2, _mm_movehl_ps(sum, sum));
  }

  /// @p nodes: indices of the first components of one node by lane.
  inline void
  gather_node(const double       *source,
              const unsigned int *nodes,
              Batch<double>::Vector (&components)[3])
  {
    const auto a = load_components(source + nodes[0]),
               b = load_components(source + nodes[1]),
               c = load_components(source + nodes[2]),
               d = load_components(source + nodes[3]);
    // x, z of lanes 0, 1, then 2, 3; likewise y
    const auto xz0 = __builtin_shufflevector(a, b, 0, 4, 2, 6),
               xz2 = __builtin_shufflevector(c, d, 0, 4, 2, 6),
               y0  = __builtin_shufflevector(a, b, 1, 5, 3, 7),
               y2  = __builtin_shufflevector(c, d, 1, 5, 3, 7);
    components[0]  = __builtin_shufflevector(xz0, xz2, 0, 1, 4, 5);
    components[1]  = __builtin_shufflevector(y0, y2, 0, 1, 4, 5);
    components[2]  = __builtin_shufflevector(xz0, xz2, 2, 3, 6, 7);
  }

  inline void
  scatter_node(const Batch<double>::Vector (&components)[3],
               const unsigned int *nodes,
               double             *target)
  {
    const auto &[x, y, z] = components;
    const auto even       = __builtin_shufflevector(x, y, 0, 4, 2, 6),
               odd        = __builtin_shufflevector(x, y, 1, 5, 3, 7);
    const auto add = [&](const unsigned int lane, const FourDoubles &values) {
      add_components(values, target + nodes[lane]);
    };
    add(0, __builtin_shufflevector(even, z, 0, 1, 4, 4));
    add(1, __builtin_shufflevector(odd, z, 0, 1, 5, 5));
    add(2, __builtin_shufflevector(even, z, 2, 3, 6, 6));
    add(3, __builtin_shufflevector(odd, z, 2, 3, 7, 7));
  }

  inline void
  gather_node(const float        *source,
              const unsigned int *nodes,
              Batch<float>::Vector (&components)[3])
  {
    const auto pair = [&](const unsigned int lane) {
      return __builtin_shufflevector(load_components(source + nodes[lane]),
                                     load_components(source + nodes[lane + 4]),
                                     0,
                                     1,
                                     2,
                                     3,
                                     4,
                                     5,
                                     6,
                                     7);
    };
    const auto a = pair(0), b = pair(1), c = pair(2), d = pair(3);
    // by halves: x, y of two lanes; z
    const auto xy0 = __builtin_shufflevector(a, b, 0, 8, 1, 9, 4, 12, 5, 13),
               xy2 = __builtin_shufflevector(c, d, 0, 8, 1, 9, 4, 12, 5, 13),
               z0  = __builtin_shufflevector(a, b, 2, 10, 3, 11, 6, 14, 7, 15),
               z2  = __builtin_shufflevector(c, d, 2, 10, 3, 11, 6, 14, 7, 15);
    components[0] = __builtin_shufflevector(xy0, xy2, 0, 1, 8, 9, 4, 5, 12, 13);
    components[1] =
      __builtin_shufflevector(xy0, xy2, 2, 3, 10, 11, 6, 7, 14, 15);
    components[2] = __builtin_shufflevector(z0, z2, 0, 1, 8, 9, 4, 5, 12, 13);
  }

  inline void
  scatter_node(const Batch<float>::Vector (&components)[3],
               const unsigned int *nodes,
               float              *target)
  {
    const auto &[x, y, z] = components;
    const auto xy0 = __builtin_shufflevector(x, y, 0, 8, 1, 9, 4, 12, 5, 13),
               xy2 = __builtin_shufflevector(x, y, 2, 10, 3, 11, 6, 14, 7, 15);
    const auto add = [&](const unsigned int lane, const auto &pair) {
      add_components(__builtin_shufflevector(pair, pair, 0, 1, 2, 3),
                     target + nodes[lane]);
      add_components(__builtin_shufflevector(pair, pair, 4, 5, 6, 7),
                     target + nodes[lane + 4]);
    };
    add(0, __builtin_shufflevector(xy0, z, 0, 1, 8, 8, 4, 5, 12, 12));
    add(1, __builtin_shufflevector(xy0, z, 2, 3, 9, 9, 6, 7, 13, 13));
    add(2, __builtin_shufflevector(xy2, z, 0, 1, 10, 10, 4, 5, 14, 14));
    add(3, __builtin_shufflevector(xy2, z, 2, 3, 11, 11, 6, 7, 15, 15));
  }
} // namespace mortise
