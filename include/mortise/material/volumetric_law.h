// The part of the change of volume in laws of isochoric stretches.
#pragma once

#include <mortise/base/batch_math.h>
#include <mortise/material/linear_elastic.h>

namespace mortise
{
  /// U = kappa / 4 (J^2 - 1 - 2 ln J). Source: Simo, Taylor (1982). In mixed
  /// form the stress has the part k ln J of the pressure that
  /// LinearElastic::displacement_lambda() says.
  class VolumetricLaw
  {
  public:
    using V = DoubleBatch;

    /// @p small: the law of small strains, kappa and the form in which a body has
    /// it.
    explicit VolumetricLaw(const LinearElastic &small);

    /// tau_m = J dU/dJ, the part tau_m I of Kirchhoff's stress, and @p slope:
    /// d tau_m / d ln J.
    void
    get(const V &ln_volume, V &mean, V &slope) const;

    /// ln J with kappa / 2 (J^2 - 1) - k ln J = -p.
    void
    dilatation_of_pressure(const V &p, V &value, V &slope) const;

  private:
    const bool   mixed;
    const double kept;       ///< k if mixed, else kappa
    const double compliance; ///< 1 / kappa
  };
} // namespace mortise
