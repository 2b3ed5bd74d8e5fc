// Evaluation of a law at one point of several cells, one per lane, from
// derivatives on the reference cell. Only sources of kernels include it.
#pragma once

#include <mortise/base/batch.h>
#include <mortise/material/kinematics.h>
#include <mortise/material/law.h>

namespace mortise
{
  /// Has the metric of a point that is needed later brought from memory, while
  /// there is more to compute than to load: of curved cells, hexahedra of
  /// degree 2 to 5 are multiplied a fifth to a half faster, tetrahedra a sixth.
  template <typename V>
  inline __attribute__((always_inline)) void
  fetch(const V *numbers, const unsigned int n)
  {
    constexpr int line = 64;
    for (unsigned int byte = 0; byte < n * sizeof(V); byte += line)
      __builtin_prefetch(reinterpret_cast<const char *>(numbers) + byte, 0, 2);
  }

  /// sqrt(w |J|) times grad u, du_c/dx_e as h[c][e]. @p g: gradients with
  /// respect to xi at this point, du_c/dxi_a at (3 c + a) stride; @p G:
  /// sqrt(w |J|) dxi_a/dx_e.
  template <typename V>
  inline __attribute__((always_inline)) void
  gradient_at(const V *g, const int stride, const V (&G)[3][3], V (&h)[3][3])
  {
    for (unsigned int c = 0; c < 3; ++c)
      {
        const V g0 = g[3 * c * stride], g1 = g[(3 * c + 1) * stride],
                g2 = g[(3 * c + 2) * stride];
        for (unsigned int e = 0; e < 3; ++e)
          h[c][e] = g0 * G[0][e] + g1 * G[1][e] + g2 * G[2][e];
      }
  }

  /// Pull-back of a stress times sqrt(w |J|), to be tested with gradients of v
  /// with respect to xi; indices as for gradient_at().
  template <typename V>
  inline __attribute__((always_inline)) void
  set_stress(const V (&s)[3][3], const V (&G)[3][3], const int stride, V *g)
  {
    for (unsigned int c = 0; c < 3; ++c)
      for (unsigned int a = 0; a < 3; ++a)
        g[(3 * c + a) * stride] =
          s[c][0] * G[a][0] + s[c][1] * G[a][1] + s[c][2] * G[a][2];
  }

  /// Contribution of the derivatives with respect to xi_i and xi_j, i <= j, to
  /// the diagonal of a function, both terms for i != j: sum_ef C_cecf G_ie G_jf
  /// at (6 c + (i, j)) stride.
  template <typename Law, typename V>
  __attribute__((noinline)) void
  diagonal_coefficients(const Law &law,
                        const V (&G)[3][3],
                        const int stride,
                        V        *result)
  {
    for (unsigned int c = 0; c < 3; ++c)
      for (unsigned int i = 0; i < 3; ++i)
        {
          V h[3][3] = {}, s[3][3];
          for (unsigned int e = 0; e < 3; ++e)
            h[c][e] = G[i][e];
          law.tangent(Undeformed(), h, s);
          for (unsigned int j = i; j < 3; ++j, result += stride)
            {
              const V sum =
                s[c][0] * G[j][0] + s[c][1] * G[j][1] + s[c][2] * G[j][2];
              *result = i == j ? sum : sum + sum;
            }
        }
  }
} // namespace mortise
