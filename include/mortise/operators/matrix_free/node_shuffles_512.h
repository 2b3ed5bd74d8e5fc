// The components of one node of several cells in registers of 64 bytes, see
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
    return (FourDoubles)_mm256_maskz_loadu_pd(7, from);
  }

  inline FourFloats
  load_components(const float *from)
  {
    return (FourFloats)_mm_maskz_loadu_ps(7, from);
  }

  inline void
  add_components(const FourDoubles &values, double *to)
  {
    _mm256_mask_storeu_pd(to, 7, (__m256d)(load_components(to) + values));
  }

  inline void
  add_components(const FourFloats &values, float *to)
  {
    _mm_mask_storeu_ps(to, 7, (__m128)(load_components(to) + values));
  }

  /// @p nodes: indices of the first components of one node by lane.
  inline void
  gather_node(const double       *source,
              const unsigned int *nodes,
              Batch<double>::Vector (&components)[3])
  {
    const auto pair = [&](const unsigned int a, const unsigned int b) {
      return __builtin_shufflevector(load_components(source + nodes[a]),
                                     load_components(source + nodes[b]),
                                     0,
                                     1,
                                     2,
                                     3,
                                     4,
                                     5,
                                     6,
                                     7);
    };
    const auto a = pair(0, 2), b = pair(1, 3), c = pair(4, 6), d = pair(5, 7);
    // x, z of lanes 0, 1, then 2, 3; of 4, 5, then 6, 7; likewise y
    const auto xz0 = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14),
               xz4 = __builtin_shufflevector(c, d, 0, 8, 2, 10, 4, 12, 6, 14),
               y0  = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15),
               y4  = __builtin_shufflevector(c, d, 1, 9, 3, 11, 5, 13, 7, 15);
    components[0] = __builtin_shufflevector(xz0, xz4, 0, 1, 4, 5, 8, 9, 12, 13);
    components[1] = __builtin_shufflevector(y0, y4, 0, 1, 4, 5, 8, 9, 12, 13);
    components[2] =
      __builtin_shufflevector(xz0, xz4, 2, 3, 6, 7, 10, 11, 14, 15);
  }

  inline void
  scatter_node(const Batch<double>::Vector (&components)[3],
               const unsigned int *nodes,
               double             *target)
  {
    const auto &[x, y, z] = components;
    const auto even = __builtin_shufflevector(x, y, 0, 8, 2, 10, 4, 12, 6, 14),
               odd  = __builtin_shufflevector(x, y, 1, 9, 3, 11, 5, 13, 7, 15);
    const auto add  = [&](const unsigned int lane, const auto &pair) {
      add_components(__builtin_shufflevector(pair, pair, 0, 1, 2, 3),
                     target + nodes[lane]);
      add_components(__builtin_shufflevector(pair, pair, 4, 5, 6, 7),
                     target + nodes[lane + 2]);
    };
    add(0, __builtin_shufflevector(even, z, 0, 1, 8, 8, 2, 3, 10, 10));
    add(1, __builtin_shufflevector(odd, z, 0, 1, 9, 9, 2, 3, 11, 11));
    add(4, __builtin_shufflevector(even, z, 4, 5, 12, 12, 6, 7, 14, 14));
    add(5, __builtin_shufflevector(odd, z, 4, 5, 13, 13, 6, 7, 15, 15));
  }

  inline void
  gather_node(const float        *source,
              const unsigned int *nodes,
              Batch<float>::Vector (&components)[3])
  {
    const auto four = [&](const unsigned int lane) {
      const auto load = [&](const unsigned int l) {
        return load_components(source + nodes[l]);
      };
      const auto low = __builtin_shufflevector(
                   load(lane), load(lane + 4), 0, 1, 2, 3, 4, 5, 6, 7),
                 high = __builtin_shufflevector(
                   load(lane + 8), load(lane + 12), 0, 1, 2, 3, 4, 5, 6, 7);
      return __builtin_shufflevector(
        low, high, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    };
    const auto a = four(0), b = four(1), c = four(2), d = four(3);
    // by quarters: x, y of two lanes; z
    const auto
      xy0 = __builtin_shufflevector(
        a, b, 0, 16, 1, 17, 4, 20, 5, 21, 8, 24, 9, 25, 12, 28, 13, 29),
      xy2 = __builtin_shufflevector(
        c, d, 0, 16, 1, 17, 4, 20, 5, 21, 8, 24, 9, 25, 12, 28, 13, 29),
      z0 = __builtin_shufflevector(
        a, b, 2, 18, 3, 19, 6, 22, 7, 23, 10, 26, 11, 27, 14, 30, 15, 31),
      z2 = __builtin_shufflevector(
        c, d, 2, 18, 3, 19, 6, 22, 7, 23, 10, 26, 11, 27, 14, 30, 15, 31);
    components[0] = __builtin_shufflevector(
      xy0, xy2, 0, 1, 16, 17, 4, 5, 20, 21, 8, 9, 24, 25, 12, 13, 28, 29);
    components[1] = __builtin_shufflevector(
      xy0, xy2, 2, 3, 18, 19, 6, 7, 22, 23, 10, 11, 26, 27, 14, 15, 30, 31);
    components[2] = __builtin_shufflevector(
      z0, z2, 0, 1, 16, 17, 4, 5, 20, 21, 8, 9, 24, 25, 12, 13, 28, 29);
  }

  inline void
  scatter_node(const Batch<float>::Vector (&components)[3],
               const unsigned int *nodes,
               float              *target)
  {
    const auto &[x, y, z] = components;
    const auto
      xy0 = __builtin_shufflevector(
        x, y, 0, 16, 1, 17, 4, 20, 5, 21, 8, 24, 9, 25, 12, 28, 13, 29),
      xy2 = __builtin_shufflevector(
        x, y, 2, 18, 3, 19, 6, 22, 7, 23, 10, 26, 11, 27, 14, 30, 15, 31);
    const auto add = [&](const unsigned int lane, const auto &four) {
      add_components(__builtin_shufflevector(four, four, 0, 1, 2, 3),
                     target + nodes[lane]);
      add_components(__builtin_shufflevector(four, four, 4, 5, 6, 7),
                     target + nodes[lane + 4]);
      add_components(__builtin_shufflevector(four, four, 8, 9, 10, 11),
                     target + nodes[lane + 8]);
      add_components(__builtin_shufflevector(four, four, 12, 13, 14, 15),
                     target + nodes[lane + 12]);
    };
    add(0,
        __builtin_shufflevector(
          xy0, z, 0, 1, 16, 16, 4, 5, 20, 20, 8, 9, 24, 24, 12, 13, 28, 28));
    add(1,
        __builtin_shufflevector(
          xy0, z, 2, 3, 17, 17, 6, 7, 21, 21, 10, 11, 25, 25, 14, 15, 29, 29));
    add(2,
        __builtin_shufflevector(
          xy2, z, 0, 1, 18, 18, 4, 5, 22, 22, 8, 9, 26, 26, 12, 13, 30, 30));
    add(3,
        __builtin_shufflevector(
          xy2, z, 2, 3, 19, 19, 6, 7, 23, 23, 10, 11, 27, 27, 14, 15, 31, 31));
  }
} // namespace mortise
