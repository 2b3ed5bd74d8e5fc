// Isotropic hyperelastic laws by the invariants of b = F F^T, without its axes.
// Sources: Simo, Pister (1984); Bonet, Wood, Nonlinear Continuum Mechanics for
// Finite Element Analysis, section 6.4.3; Holzapfel, Nonlinear Solid Mechanics,
// sections 6.5 and 6.6.
#pragma once

#include <mortise/material/nonlinear_law.h>
#include <mortise/material/volumetric_law.h>

namespace mortise
{
  /// W = mu / 2 (tr C - 3 - 2 ln J) + lambda / 2 ln^2 J: tau = mu (b - I) +
  /// lambda ln J I.
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

  /// W = lambda / 2 tr^2 E + mu E : E in Green's strain E: tau = lambda tr E b
  /// + mu (b^2 - b).
  class StVenantKirchhoff : public NonlinearLaw
  {
  public:
    StVenantKirchhoff(const double lambda, const double mu)
      : lambda(lambda)
      , mu(mu)
    {}

    TangentForm
    form() const override
    {
      return TangentForm::full_finite;
    }

    void
    stress(const V (&h)[3][3], const V *, V *, V (&tau)[3][3]) const override;

    void
    tangent(const V (&h)[3][3], const V *, V *moduli) const override;

  private:
    const double lambda, mu;
  };

  /// W = C10 (I1 - 3) + C01 (I2 - 3) + U(J) with the invariants of J^(-2/3) b
  /// and U of VolumetricLaw.
  class MooneyRivlin : public NonlinearLaw
  {
  public:
    MooneyRivlin(const VolumetricLaw &volume,
                 const double         c10,
                 const double         c01)
      : volume(volume)
      , c10(c10)
      , c01(c01)
    {}

    TangentForm
    form() const override
    {
      return TangentForm::full_finite;
    }

    void
    stress(const V (&h)[3][3], const V *, V *, V (&tau)[3][3]) const override;

    void
    tangent(const V (&h)[3][3], const V *, V *moduli) const override;

    void
    dilatation_of_pressure(const V &p, V &value, V &slope) const override
    {
      volume.dilatation_of_pressure(p, value, slope);
    }

  private:
    const VolumetricLaw volume;
    const double        c10, c01; ///< force per area
  };
} // namespace mortise
