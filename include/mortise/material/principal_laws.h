// Isotropic hyperelastic laws by their principal stretches l_a: Hencky's and
// Ogden's. Source: Ogden, Non-Linear Elastic Deformations, section 4.3;
// Holzapfel, Nonlinear Solid Mechanics, section 6.5.
#pragma once

#include <mortise/material/logarithmic_law.h>
#include <mortise/material/volumetric_law.h>

#include <vector>

namespace mortise
{
  class PrincipalLaw : public LogarithmicLaw
  {
  public:
    using LogarithmicLaw::LogarithmicLaw;

  protected:
    void
    stress_in_axes(const Strain &strain,
                   const V *,
                   V *,
                   V (&T)[3][3]) const override;

    void
    moduli_in_axes(const Strain &strain,
                   const V *,
                   V (&T)[3][3],
                   V (&D)[6][6]) const override;

  private:
    /// The principal Kirchhoff stresses tau_a = dW / d ln l_a and their
    /// derivatives slope[a][b] = d tau_a / d ln l_b.
    virtual void
    principal(const Strain &strain, V (&tau)[3], V (&slope)[3][3]) const = 0;
  };

  /// W = lambda / 2 tr^2 E + mu E : E in the logarithmic strain E.
  class Hencky : public PrincipalLaw
  {
  public:
    /// @p compressibility: see NonlinearLaw.
    Hencky(const double lambda,
           const double mu,
           const double compressibility = 0.)
      : PrincipalLaw(compressibility)
      , lambda(lambda)
      , mu(mu)
    {}

  private:
    void
    principal(const Strain &strain,
              V (&tau)[3],
              V (&slope)[3][3]) const override;

    const double lambda, mu;
  };

  /// W = sum_p mu_p / alpha_p (sum_a J^(-alpha_p / 3) l_a^alpha_p - 3) + U(J)
  /// with U of VolumetricLaw.
  class Ogden : public PrincipalLaw
  {
  public:
    struct Term
    {
      double modulus;  ///< mu_p, force per area
      double exponent; ///< alpha_p, not zero
    };

    Ogden(const VolumetricLaw &volume, const std::vector<Term> &terms)
      : volume(volume)
      , terms(terms)
    {}

    /// mu = sum_p mu_p alpha_p / 2, the shear modulus of small strains.
    static double
    shear_modulus(const std::vector<Term> &terms);

    void
    dilatation_of_pressure(const V &p, V &value, V &slope) const override
    {
      volume.dilatation_of_pressure(p, value, slope);
    }

  private:
    void
    principal(const Strain &strain,
              V (&tau)[3],
              V (&slope)[3][3]) const override;

    const VolumetricLaw     volume;
    const std::vector<Term> terms;
  };
} // namespace mortise
