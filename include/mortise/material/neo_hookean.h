// The neo-Hookean law W = mu / 2 (tr C - 3 - 2 ln J) + lambda / 2 ln^2 J.
// Sources: Simo, Pister (1984); Bonet, Wood, Nonlinear Continuum Mechanics for
// Finite Element Analysis, section 6.4.3.
#pragma once

#include <mortise/material/nonlinear_law.h>

namespace mortise
{
  /// tau = mu (b - I) + lambda ln J I.
  class NeoHookean : public NonlinearLaw
  {
  public:
    /// Lame's constants of small strains, force per area; @p compressibility: see
    /// NonlinearLaw.
    NeoHookean(const double lambda,
               const double mu,
               const double compressibility = 0.)
      : NonlinearLaw(compressibility)
      , lambda(lambda)
      , mu(mu)
    {}

    TangentForm
    form() const override
    {
      return TangentForm::isotropic_finite;
    }

    void
    stress(const V (&h)[3][3], const V *, V *, V (&tau)[3][3]) const override;

    void
    tangent(const V (&h)[3][3], const V *, V *moduli) const override;

  private:
    const double lambda, mu;
  };
} // namespace mortise
