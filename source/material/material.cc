#include <mortise/material/material.h>


namespace mortise
{
  using namespace dealii;

  SymmetricTensor<2, 3>
  Material::stress(const Tensor<2, 3> &gradient) const
  {
    return std::visit(
      [&](const auto &any) { return stress_at(any.law(), gradient); }, law);
  }

  SymmetricTensor<2, 3>
  Material::stress(const Tensor<2, 3> &gradient, const double pressure) const
  {
    SymmetricTensor<2, 3> sigma = std::visit(
      [&](const auto &any) {
        return stress_at(any.displacement_law(), gradient);
      },
      law);
    for (unsigned int d = 0; d < 3; ++d)
      sigma[d][d] -= pressure;
    return sigma;
  }

  Tensor<1, 3>
  Material::body_force(
    const std::array<SymmetricTensor<2, 3>, 3> &hessian) const
  {
    // d sigma_ij / dx_j is the stress of the derivative of the gradient
    Tensor<1, 3> force;
    for (unsigned int j = 0; j < 3; ++j)
      {
        Tensor<2, 3> slope;
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int k = 0; k < 3; ++k)
            slope[i][k] = hessian[i][k][j];
        const SymmetricTensor<2, 3> sigma =
          incompressible() ? stress(slope, 0.) : stress(slope);
        for (unsigned int i = 0; i < 3; ++i)
          force[i] -= sigma[i][j];
      }
    return force;
  }

  double
  Material::stiffness_ratio() const
  {
    const LinearElastic any = averages().voigt;
    return 2. + any.displacement_lambda() / any.lame_mu();
  }
} // namespace mortise
