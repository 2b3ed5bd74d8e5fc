// Deformation at one point of several cells from h[i][j] = du_i/dX_j, without
// cancellation where it is small.
#pragma once

#include <mortise/base/batch_math.h>

namespace mortise
{
  template <typename V>
  inline __attribute__((always_inline)) V
  determinant_of(const V (&a)[3][3])
  {
    return a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) -
           a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
           a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
  }

  /// J - 1 = tr h + (second invariant of h) + det h.
  template <typename V>
  inline V
  dilatation(const V (&h)[3][3])
  {
    V sum = h[0][0] + h[1][1] + h[2][2] + determinant_of(h);
    for (unsigned int i = 0; i < 3; ++i)
      {
        const unsigned int j = (i + 1) % 3;
        sum += h[i][i] * h[j][j] - h[i][j] * h[j][i];
      }
    return sum;
  }

  /// @p inverse of @p a, whose determinant is @p det, by cofactors.
  template <typename V>
  inline void
  invert(const V (&a)[3][3], const V &det, V (&inverse)[3][3])
  {
    const V factor = (V{} + 1) / det;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        {
          const unsigned int p = (i + 1) % 3, q = (i + 2) % 3, r = (j + 1) % 3,
                             s = (j + 2) % 3;
          inverse[j][i] = factor * (a[p][r] * a[q][s] - a[p][s] * a[q][r]);
        }
  }

  /// @p inverse: F^{-1} of F = I + h, with J = det F.
  template <typename V>
  inline void
  invert_gradient(const V (&h)[3][3], const V &J, V (&inverse)[3][3])
  {
    V F[3][3];
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        F[i][j] = i == j ? 1. + h[i][j] : h[i][j];
    invert(F, J, inverse);
  }

  /// Eigenvalues @p value and, as columns of @p axes, eigenvectors of the
  /// symmetric @p a, which is used up, by Jacobi's rotations.
  void eigensystem(DoubleBatch (&a)[3][3],
                   DoubleBatch (&value)[3],
                   DoubleBatch (&axes)[3][3]);

  /// C - I = h + h^T + h^T h of C = F^T F.
  template <typename V>
  inline void
  right_strain(const V (&h)[3][3], V (&strain)[3][3])
  {
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = i; j < 3; ++j)
        {
          V sum = h[i][j] + h[j][i];
          for (unsigned int k = 0; k < 3; ++k)
            sum += h[k][i] * h[k][j];
          strain[i][j] = strain[j][i] = sum;
        }
  }
} // namespace mortise
