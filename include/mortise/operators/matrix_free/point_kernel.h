// Between derivatives on the reference cell and what a law has at one point of
// several cells, one per lane. It never knows where points lie; only sources of
// kernels include it.
#pragma once

#include <mortise/material/law.h>

namespace mortise
{
  /// Has the metric of a point that is needed later brought from memory, while
  /// there is more to compute than to load: of curved cells, hexahedra of
  /// degree 2 to 5 are multiplied a fifth to a half faster, tetrahedra a sixth.
  template <typename V>
  inline __attribute__((always_inline)) void
  fetch_metric(const V *G)
  {
    constexpr int line = 64;
    for (unsigned int byte = 0; byte < 9 * sizeof(V); byte += line)
      __builtin_prefetch(reinterpret_cast<const char *>(G) + byte, 0, 2);
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

  /// What is tested with gradients of v with respect to xi, from a stress times
  /// sqrt(w |J|); indices as for gradient_at().
  template <typename V>
  inline __attribute__((always_inline)) void
  set_stress(const V (&s)[3][3], const V (&G)[3][3], const int stride, V *g)
  {
    for (unsigned int c = 0; c < 3; ++c)
      for (unsigned int a = 0; a < 3; ++a)
        g[(3 * c + a) * stride] =
          s[c][0] * G[a][0] + s[c][1] * G[a][1] + s[c][2] * G[a][2];
  }

  /// What the component c of a function alone contributes to its diagonal by
  /// its derivatives with respect to xi_i and xi_j, both terms for i != j:
  /// sum_ef C_cecf G_ie G_jf, @p G as the rows of the metric.
  template <typename Law, typename V>
  inline __attribute__((always_inline)) V
  diagonal_coefficient(const Law         &law,
                       const unsigned int c,
                       const unsigned int i,
                       const unsigned int j,
                       const V           *G)
  {
    V h[3][3] = {}, s[3][3];
    for (unsigned int e = 0; e < 3; ++e)
      h[c][e] = G[3 * i + e];
    law.tangent(Undeformed(), h, s);
    const V sum =
      s[c][0] * G[3 * j] + s[c][1] * G[3 * j + 1] + s[c][2] * G[3 * j + 2];
    return i == j ? sum : sum + sum;
  }
} // namespace mortise
