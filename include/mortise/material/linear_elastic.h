// Isotropic linear elasticity in three dimensions (and plane strain, which is
// the same law), compressible or not, and how a mixed form shares it between
// displacement and pressure. It never knows a discretisation.
#pragma once

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <string>

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
    /// with lambda_u and c below; else by stress(strain).
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

    /// The stress by displacement and pressure, which is zero if not mixed.
    dealii::SymmetricTensor<2, 3>
    stress(const dealii::SymmetricTensor<2, 3> &strain,
           const double                         pressure) const
    {
      dealii::SymmetricTensor<2, 3> sigma = 2. * lame_mu() * strain;
      const double mean = displacement_lambda() * trace(strain) - pressure;
      for (unsigned int d = 0; d < 3; ++d)
        sigma[d][d] += mean;
      return sigma;
    }

    /// The pressure p of the mixed form that belongs to a strain and its
    /// stress.
    double
    pressure(const dealii::SymmetricTensor<2, 3> &strain,
             const dealii::SymmetricTensor<2, 3> &stress) const
    {
      return ((2. * lame_mu() + 3. * displacement_lambda()) * trace(strain) -
              trace(stress)) /
             3.;
    }

    /// sigma = lambda tr(strain) I + 2 mu strain, tensor components (not
    /// engineering shears); nu < 0.5.
    dealii::SymmetricTensor<2, 3>
    stress(const dealii::SymmetricTensor<2, 3> &strain) const
    {
      dealii::SymmetricTensor<2, 3> sigma = 2. * lame_mu() * strain;
      const double                  mean  = lame_lambda() * trace(strain);
      for (unsigned int d = 0; d < 3; ++d)
        sigma[d][d] += mean;
      return sigma;
    }

    /// Force per volume that balances a displacement with second derivatives @p hessian
    /// (hessian[i] of u_i): b = -div sigma = -(lambda + mu) grad div u - mu
    /// laplace u.
    dealii::Tensor<1, 3>
    body_force(
      const std::array<dealii::SymmetricTensor<2, 3>, 3> &hessian) const;

    /// Throw InputError unless E > 0 and -1 < nu < 0.5, or 0 < nu <= 0.5 if mixed; @p where names the
    /// subsection in the message.
    void
    validate(const std::string &where) const;
  };
} // namespace mortise
