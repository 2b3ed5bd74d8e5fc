// Stresses that go on linearly from one iterate of Newton's method to the next.
// Only sources of kernels include this.
#pragma once

#include <mortise/material/kinematics.h>
#include <mortise/material/law.h>
#include <mortise/operators/matrix_free/tangent_kernel_on.h>

#include <algorithm>

namespace mortise
{
  /// The state of a point of several cells at an iterate.
  template <typename Number>
  struct StressedPoint
  {
    using V = typename Batch<Number>::Vector;

    V h[dim][dim];   ///< F - I, without thermal strain
    V tau[dim][dim]; ///< Kirchhoff's stress, force per area
    V p;             ///< the pressure in mixed form, part of tau

    /// @p of_next: f (tau + c : sym g - dp I) f^T for the next iterate, whose
    /// F - I is @p next and whose pressure is @p pressure, with f = I + g, F_next
    /// = f F, and the moduli c, pressures included, from the @p numbers of a
    /// tangent here, which are multiplied by @p volume. In the undeformed
    /// configuration it is S + C : sym(F^T Grad du). Source: Magisano,
    /// Leonetti, Garcea, see MatrixFreeElasticity::linearise().
    void
    get_linear(const TangentForm form,
               const V          *numbers,
               const V          &volume,
               const V (&next)[dim][dim],
               const V &pressure,
               V (&of_next)[dim][dim]) const
    {
      V inverse[dim][dim], g[dim][dim], s[dim][dim];
      invert_gradient(h, 1. + dilatation(h), inverse);
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          {
            g[i][j] = V{};
            for (unsigned int a = 0; a < dim; ++a)
              g[i][j] += (next[i][a] - h[i][a]) * inverse[a][j];
          }
      with_form(form, [&](const auto of) {
        V moduli[n_tangent(of())] = {}; // without initial stress
        std::copy(numbers, numbers + n_moduli(of()), moduli);
        TangentAt<Number, of()>{moduli}.tangent(Undeformed(), g, s);
      });
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          s[i][j] = tau[i][j] + s[i][j] / volume;
      for (unsigned int c = 0; c < dim; ++c)
        {
          s[c][c] -= pressure - p;
          g[c][c] += 1.;
        }
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          {
            of_next[i][j] = V{};
            for (unsigned int a = 0; a < dim; ++a)
              for (unsigned int b = 0; b < dim; ++b)
                of_next[i][j] += g[i][a] * s[a][b] * g[j][b];
          }
    }
  };
} // namespace mortise
