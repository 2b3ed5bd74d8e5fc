#include <mortise/material/volumetric_law.h>

namespace mortise
{
  VolumetricLaw::VolumetricLaw(const LinearElastic &small)
    : mixed(small.mixed)
    , kept(small.displacement_lambda() + 2. / 3. * small.lame_mu())
    , compliance(3. * (1. - 2. * small.poisson_ratio) / small.young_modulus)
  {}

  void
  VolumetricLaw::get(const V &ln_volume, V &mean, V &slope) const
  {
    const V square = expm1(2. * ln_volume); // J^2 - 1
    mean           = kept * (mixed ? ln_volume : 0.5 * square);
    slope          = kept * (mixed ? V{} + 1. : 1. + square);
  }

  void
  VolumetricLaw::dilatation_of_pressure(const V &p, V &value, V &slope) const
  {
    // (exp(2 x) - 1) / 2 - k / kappa x + p / kappa = 0
    const double share = kept * compliance;
    V            x     = -p * compliance / (1. - share);
    for (unsigned int k = 0; k < 8; ++k)
      {
        const V square = expm1(2. * x);
        x -=
          (0.5 * square - share * x + p * compliance) / (1. + square - share);
      }
    value = x;
    slope = -compliance / (1. + expm1(2. * x) - share);
  }
} // namespace mortise
