// Isotropic linear elasticity in three dimensions (and plane strain, which is
// the same law), compressible or not, and how a mixed form shares it between
// displacement and pressure.
#pragma once

#include <mortise/material/law.h>

namespace mortise
{
  struct LinearElastic
  {
    double young_modulus = 1.;  ///< E, force per area
    double poisson_ratio = 0.3; ///< nu, -1 < nu < 0.5; 0 < nu <= 0.5 if mixed
    /// The form in which a body has the law: with a pressure of its own,
    ///
    ///     sigma = 2 mu strain + lambda_u tr(strain) I - p I,  tr(strain) + c p
    ///     = 0,
    ///
    /// with lambda_u and c below; else by law().
    bool mixed = false;

    /// lambda = E nu / ((1 + nu) (1 - 2 nu)); infinite for nu = 0.5.
    double
    lame_lambda() const
    {
      return young_modulus * poisson_ratio /
             ((1. + poisson_ratio) * (1. - 2. * poisson_ratio));
    }

    /// mu = E / (2 (1 + nu)), the shear modulus.
    double
    lame_mu() const
    {
      return young_modulus / (2. * (1. + poisson_ratio));
    }

    bool
    incompressible() const
    {
      return poisson_ratio == 0.5;
    }

    /// lambda_u, what the displacement keeps of lambda: all of it, or if mixed
    /// 1 / (1 / lambda + 1 / (kept mu)), which is bounded. The more it keeps
    /// the better a mass matrix of pressures stands for their Schur complement,
    /// and the worse conditioned is the displacement's own block.
    double
    displacement_lambda() const;

    /// c = 1 / (lambda - lambda_u) if mixed: zero for nu = 0.5.
    double
    compressibility() const;

    /// c + 1 / (2/3 mu + lambda_u): with it a mass matrix of pressures bounds
    /// their Schur complement from above, to which dilations come closest.
    double
    pressure_norm() const
    {
      return compressibility() +
             1. / (2. / 3. * lame_mu() + displacement_lambda());
    }

    /// The whole law; nu < 0.5.
    template <typename Number = double>
    IsotropicLaw<Number>
    law() const
    {
      return {Number(lame_lambda()), Number(lame_mu())};
    }

    /// The share of the displacement: all of it if not mixed.
    template <typename Number = double>
    IsotropicLaw<Number>
    displacement_law() const
    {
      return {Number(displacement_lambda()), Number(lame_mu())};
    }

    /// Of all directions: the law itself twice.
    struct Averages;
    Averages
    averages() const;
  };

  /// Averages over all directions of the stiffness (Voigt), an upper bound, and
  /// of the compliance (Reuss), a lower one.
  struct LinearElastic::Averages
  {
    LinearElastic voigt, reuss;
  };

  inline LinearElastic::Averages
  LinearElastic::averages() const
  {
    return {*this, *this};
  }
} // namespace mortise
