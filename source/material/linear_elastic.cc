#include <mortise/material/linear_elastic.h>

namespace mortise
{
  namespace
  {
    /// lambda_u / mu of an incompressible body.
    constexpr double kept = 0.5;
  } // namespace

  double
  LinearElastic::displacement_lambda() const
  {
    if (!mixed)
      return lame_lambda();
    // lambda = mu s / (1 - s), which need not exist
    const double s = 2. * poisson_ratio;
    return kept * lame_mu() * s / (kept * (1. - s) + s);
  }

  double
  LinearElastic::compressibility() const
  {
    const double s = 2. * poisson_ratio;
    return (1. - s) * (s + kept * (1. - s)) / (s * s * lame_mu());
  }
} // namespace mortise
