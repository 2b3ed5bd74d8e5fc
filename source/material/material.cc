#include <deal.II/base/aligned_vector.h>

#include <mortise/material/kinematics.h>
#include <mortise/material/material.h>
#include <mortise/material/nonlinear_law.h>


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

  bool
  Material::has_finite_strain() const
  {
    return nonlinear_law && is_finite(nonlinear_law->form());
  }

  Material::Response
  Material::respond(const Tensor<2, 3> &gradient,
                    const double        pressure,
                    const double       *history) const
  {
    Response result;
    if (!nonlinear_law)
      {
        result.cauchy  = stress(gradient, pressure);
        result.nominal = result.cauchy;
        return result;
      }
    // one point in all lanes
    DoubleBatch h[3][3], s[3][3], inverse[3][3];
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        h[i][j] = DoubleBatch{} + gradient[i][j];
    const unsigned int n = nonlinear_law->n_history();
    // vectors of the compiler are aligned
    dealii::AlignedVector<double> numbers(n * Batch<double>::size);
    for (unsigned int k = 0; history != nullptr && k < n; ++k)
      for (unsigned int l = 0; l < Batch<double>::size; ++l)
        numbers[k * Batch<double>::size + l] = history[k];
    nonlinear_law->stress(h,
                          reinterpret_cast<const DoubleBatch *>(numbers.data()),
                          nullptr,
                          s);
    for (unsigned int i = 0; i < 3; ++i)
      s[i][i] -= pressure;
    const bool        finite = has_finite_strain();
    const DoubleBatch J      = finite ? 1. + dilatation(h) : DoubleBatch{} + 1.;
    invert_gradient(h, J, inverse);
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        {
          if (i <= j)
            result.cauchy[i][j] = s[i][j][0] / J[0];
          result.nominal[i][j] = s[i][j][0];
          if (finite)
            result.nominal[i][j] = s[i][0][0] * inverse[j][0][0] +
                                   s[i][1][0] * inverse[j][1][0] +
                                   s[i][2][0] * inverse[j][2][0];
        }
    return result;
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
