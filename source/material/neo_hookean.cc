#include <mortise/material/kinematics.h>
#include <mortise/material/neo_hookean.h>

namespace mortise
{
  void
  NeoHookean::stress(const V (&h)[3][3], const V *, V *, V (&tau)[3][3]) const
  {
    const V mean = lambda * log1p(dilatation(h));
    // b - I = h + h^T + h h^T
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = i; j < 3; ++j)
        {
          V sum = h[i][j] + h[j][i];
          for (unsigned int k = 0; k < 3; ++k)
            sum += h[i][k] * h[j][k];
          tau[i][j] = tau[j][i] = mu * sum;
        }
    for (unsigned int i = 0; i < 3; ++i)
      tau[i][i] += mean;
  }

  void
  NeoHookean::tangent(const V (&h)[3][3], const V *, V *moduli) const
  {
    moduli[0] = mu - lambda * log1p(dilatation(h));
    moduli[1] = V{} + lambda;
  }
} // namespace mortise
