#include <mortise/material/kinematics.h>

namespace mortise
{
  using V = DoubleBatch;

  namespace
  {
    void
    rotate(V (&a)[3][3], V (&axes)[3][3], const unsigned int p)
    {
      const unsigned int q = (p + 1) % 3, r = (p + 2) % 3;
      const V            off = a[p][q], difference = a[q][q] - a[p][p];
      const V            norm =
        fabs(difference) + sqrt(difference * difference + 4. * off * off);
      // tan of the smaller angle that makes a[p][q] vanish
      const V t =
        norm > 0. ? (difference < 0. ? -2. * off : 2. * off) / norm : V{};
      const V c = 1. / sqrt(1. + t * t), s = t * c;
      a[p][p] -= t * off;
      a[q][q] += t * off;
      a[p][q] = a[q][p] = V{};
      const V x = a[r][p], y = a[r][q];
      a[r][p] = a[p][r] = c * x - s * y;
      a[r][q] = a[q][r] = s * x + c * y;
      for (unsigned int i = 0; i < 3; ++i)
        {
          const V first = axes[i][p], second = axes[i][q];
          axes[i][p] = c * first - s * second;
          axes[i][q] = s * first + c * second;
        }
    }
    /// To rounding, in all lanes?
    bool
    is_diagonal(const V (&a)[3][3])
    {
      constexpr double rounding = 1e-17;
      const V          beside   = fabs(a[0][1]) + fabs(a[1][2]) + fabs(a[2][0]),
              sizes             = fabs(a[0][0]) + fabs(a[1][1]) + fabs(a[2][2]);
      for (unsigned int l = 0; l < Batch<double>::size; ++l)
        if (beside[l] > rounding * sizes[l])
          return false;
      return true;
    }
  } // namespace

  void
  eigensystem(V (&a)[3][3], V (&value)[3], V (&axes)[3][3])
  {
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        axes[i][j] = V{} + (i == j ? 1. : 0.);
    // each sweep at least squares what is left beside the diagonal
    constexpr unsigned int most_sweeps = 5;
    for (unsigned int sweep = 0; sweep < most_sweeps; ++sweep)
      {
        for (unsigned int p = 0; p < 3; ++p)
          rotate(a, axes, p);
        if (is_diagonal(a))
          break;
      }
    for (unsigned int i = 0; i < 3; ++i)
      value[i] = a[i][i];
  }
} // namespace mortise
