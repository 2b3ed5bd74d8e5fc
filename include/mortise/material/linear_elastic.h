// Isotropic linear elasticity in three dimensions (and plane strain, which is
// the same law). It never treats the incompressible limit: Poisson's ratio is
// below 0.5.
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
    double poisson_ratio = 0.3; ///< nu, -1 < nu < 0.5

    /// lambda = E nu / ((1 + nu) (1 - 2 nu)).
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

    /// sigma = lambda tr(strain) I + 2 mu strain, tensor components (not
    /// engineering shears).
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

    /// Throw InputError unless E > 0 and -1 < nu < 0.5 (both finite); @p where names the
    /// subsection in the message.
    void
    validate(const std::string &where) const;
  };
} // namespace mortise
