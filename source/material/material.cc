#include <deal.II/base/aligned_vector.h>

#include <mortise/material/kinematics.h>
#include <mortise/material/material.h>
#include <mortise/material/nonlinear_law.h>

#include <cmath>

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

  namespace
  {
    using Lanes = DoubleBatch[3][3];

    /// One point in all lanes.
    void
    spread(const Tensor<2, 3> &tensor, Lanes &result)
    {
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          result[i][j] = DoubleBatch{} + tensor[i][j];
    }

    Tensor<2, 3>
    first_of(const Lanes &lanes)
    {
      Tensor<2, 3> result;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          result[i][j] = lanes[i][j][0];
      return result;
    }
  } // namespace

  Tensor<2, 3>
  deformation_gradient(const Tensor<2, 3> &gradient)
  {
    return Tensor<2, 3>(unit_symmetric_tensor<3>()) + gradient;
  }

  double
  Material::thermal_stretch(const double thermal_strain) const
  {
    return has_finite_strain() ? 1. + thermal_strain : 1.;
  }

  Tensor<2, 3>
  Material::elastic_gradient(Tensor<2, 3> gradient,
                             const double thermal_strain) const
  {
    for (unsigned int c = 0; c < 3; ++c)
      gradient[c][c] -= thermal_strain;
    return gradient / thermal_stretch(thermal_strain);
  }

  double
  Material::pressure(const Tensor<2, 3>          &gradient,
                     const SymmetricTensor<2, 3> &stress) const
  {
    const double rest = trace(respond(gradient, 0.).cauchy - stress) / 3.;
    return has_finite_strain() ?
             determinant(deformation_gradient(gradient)) * rest :
             rest;
  }

  double
  Material::hooke_energy(const Tensor<2, 3> &gradient,
                         const double        pressure) const
  {
    return scalar_product(Tensor<2, 3>(stress(gradient, 0.)), gradient) +
           (mixed() ? compressibility() * pressure * pressure : 0.);
  }

  double
  Material::twice_energy(const Tensor<2, 3> &gradient,
                         const double        pressure) const
  {
    if (!has_finite_strain())
      return hooke_energy(gradient, pressure);
    DoubleBatch h[3][3], strain[3][3], value[3], axes[3][3];
    spread(gradient, h);
    right_strain(h, strain);
    eigensystem(strain, value, axes);
    Tensor<2, 3> logarithmic;
    for (unsigned int i = 0; i < 3; ++i)
      logarithmic[i][i] = 0.5 * std::log1p(value[i][0]);
    return hooke_energy(logarithmic, pressure);
  }

  double
  Material::twice_energy_of_change(const Tensor<2, 3> &gradient,
                                   const Tensor<2, 3> &change,
                                   const double        pressure_change) const
  {
    return hooke_energy(has_finite_strain() ?
                          change * invert(deformation_gradient(gradient)) :
                          change,
                        pressure_change);
  }

  bool
  Material::has_finite_strain() const
  {
    return nonlinear_law && is_finite(nonlinear_law->form());
  }

  double
  Material::dilatation(const Tensor<2, 3> &gradient) const
  {
    if (!has_finite_strain())
      return trace(gradient);
    Lanes h;
    spread(gradient, h);
    return std::log1p(mortise::dilatation(h)[0]);
  }

  Material::PressureDilatation
  Material::dilatation_of_pressure(const double p) const
  {
    if (!nonlinear_law)
      return {-compressibility() * p, -compressibility()};
    DoubleBatch value, slope;
    nonlinear_law->dilatation_of_pressure(DoubleBatch{} + p, value, slope);
    return {value[0], slope[0]};
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
    DoubleBatch h[3][3], s[3][3], inverse[3][3];
    spread(gradient, h);
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
    const DoubleBatch J =
      finite ? 1. + mortise::dilatation(h) : DoubleBatch{} + 1.;
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

  Tensor<2, 3>
  Material::nominal_change(const Tensor<2, 3> &gradient,
                           const double        pressure,
                           const Tensor<2, 3> &change,
                           const double        pressure_change) const
  {
    if (!nonlinear_law)
      return stress(change, pressure_change);
    const TangentForm form   = nonlinear_law->form();
    const bool        finite = is_finite(form);
    DoubleBatch       h[3][3], along[3][3], s[3][3];
    spread(gradient, h);
    AlignedVector<double> none(nonlinear_law->n_history() *
                               Batch<double>::size);
    const auto *before = reinterpret_cast<const DoubleBatch *>(none.data());
    DoubleBatch moduli[n_tangent(TangentForm::full_finite)] = {};
    nonlinear_law->tangent(h, before, moduli);
    const Tensor<2, 3> inverse =
      finite ? invert(deformation_gradient(gradient)) : Tensor<2, 3>();
    const Tensor<2, 3> in_space = finite ? change * inverse : change;
    spread(in_space, along);
    with_form(form, [&](const auto of) {
      // without initial stress
      TangentAt<double, of()>{moduli}.tangent(Undeformed(), along, s);
    });
    Tensor<2, 3> result = first_of(s);
    if (finite)
      {
        nonlinear_law->stress(h, before, nullptr, s);
        result += in_space * first_of(s) + pressure * transpose(in_space);
      }
    for (unsigned int i = 0; i < 3; ++i)
      result[i][i] -= pressure_change;
    return finite ? result * transpose(inverse) : result;
  }

  double
  Material::stiffness_ratio() const
  {
    const LinearElastic any = averages().voigt;
    return 2. + any.displacement_lambda() / any.lame_mu();
  }
} // namespace mortise
