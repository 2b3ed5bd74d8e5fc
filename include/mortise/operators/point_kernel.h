// Linear elasticity at one point of several cells, one per lane. It never knows
// where points lie; only sources of kernels include it.
#pragma once

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

  template <typename V, typename Number>
  inline __attribute__((always_inline)) void
  stress_of(const V (&h)[3][3],
            const Number lambda,
            const Number mu,
            V (&s)[3][3])
  {
    const V mean = lambda * (h[0][0] + h[1][1] + h[2][2]);
    for (unsigned int c = 0; c < 3; ++c)
      for (unsigned int e = c; e < 3; ++e)
        s[c][e] = s[e][c] = mu * (h[c][e] + h[e][c]);
    for (unsigned int c = 0; c < 3; ++c)
      s[c][c] += mean;
  }

  /// What is tested with gradients of v with respect to xi, from a stress times
  /// sqrt(w |J|); places as for gradient_at().
  template <typename V>
  inline __attribute__((always_inline)) void
  set_stress(const V (&s)[3][3], const V (&G)[3][3], const int stride, V *g)
  {
    for (unsigned int c = 0; c < 3; ++c)
      for (unsigned int a = 0; a < 3; ++a)
        g[(3 * c + a) * stride] =
          s[c][0] * G[a][0] + s[c][1] * G[a][1] + s[c][2] * G[a][2];
  }
} // namespace mortise
