// Isotropic hyperelastic laws by their principal stretches l_a: Hencky's, St.
// Venant and Kirchhoff's, Ogden's, of which Mooney and Rivlin's and the
// neo-Hookean law of the isochoric stretches are cases. Source: Ogden,
// Non-Linear Elastic Deformations, section 4.3; Holzapfel, Nonlinear Solid
// Mechanics, section 6.5.
#pragma once

#include <mortise/material/linear_elastic.h>
#include <mortise/material/logarithmic_law.h>

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

  /// W = lambda / 2 tr^2 E + mu E : E in Green's strain E.
  class StVenantKirchhoff : public PrincipalLaw
  {
  public:
    StVenantKirchhoff(const double lambda, const double mu)
      : lambda(lambda)
      , mu(mu)
    {}

  private:
    void
    principal(const Strain &strain,
              V (&tau)[3],
              V (&slope)[3][3]) const override;

    const double lambda, mu;
  };

  /// W = sum_p mu_p / alpha_p (sum_a J^(-alpha_p / 3) l_a^alpha_p - 3) + kappa
  /// / 4 (J^2 - 1 - 2 ln J).
  class Ogden : public PrincipalLaw
  {
  public:
    struct Term
    {
      double modulus;  ///< mu_p, force per area
      double exponent; ///< alpha_p, not zero
    };

    /// @p small: the law of small strains, kappa and the form in which a body has
    /// it: in mixed form the stress has the part k ln J of the pressure that
    /// LinearElastic::displacement_lambda() says.
    Ogden(const LinearElastic &small, const std::vector<Term> &terms);

    /// mu = sum_p mu_p alpha_p / 2, the shear modulus of small strains.
    static double
    shear_modulus(const std::vector<Term> &terms);

    /// ln J with kappa / 2 (J^2 - 1) - k ln J = -p.
    void
    dilatation_of_pressure(const V &p, V &value, V &slope) const override;

  private:
    void
    principal(const Strain &strain,
              V (&tau)[3],
              V (&slope)[3][3]) const override;

    const bool              mixed;
    const double            kept;       ///< k if mixed, else kappa
    const double            compliance; ///< 1 / kappa
    const std::vector<Term> terms;
  };
} // namespace mortise
