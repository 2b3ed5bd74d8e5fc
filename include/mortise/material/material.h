// The material of a body: one of the laws there are, and what operators,
// solvers and output ask of it.
#pragma once

#include <mortise/material/orthotropic.h>

#include <memory>

namespace mortise
{
  class NonlinearLaw;

  /// F = I + @p gradient, that of the displacement.
  dealii::Tensor<2, 3>
  deformation_gradient(const dealii::Tensor<2, 3> &gradient);

  class Material
  {
  public:
    Material(const LinearElastic &law = LinearElastic())
      : law(law)
    {}

    /// A law that is @p tangent at small strains.
    Material(const LinearElastic                &tangent,
             std::shared_ptr<const NonlinearLaw> law)
      : law(tangent)
      , nonlinear_law(std::move(law))
    {}

    Material(const Orthotropic &law)
      : law(law)
    {}

    /// Moduli from gradients of the displacement to stresses in the form of the
    /// body, see LinearElastic::mixed.
    template <typename Number = double>
    PointLaw<Number>
    displacement_law() const
    {
      return std::visit(
        [](const auto &any) {
          return PointLaw<Number>(any.template displacement_law<Number>());
        },
        law);
    }

    /// The stress without regard to the form, @p gradient [i][j] = du_i/dx_j;
    /// not of incompressible materials.
    dealii::SymmetricTensor<2, 3>
    stress(const dealii::Tensor<2, 3> &gradient) const;

    /// The stress by displacement and pressure, which is zero if not mixed.
    dealii::SymmetricTensor<2, 3>
    stress(const dealii::Tensor<2, 3> &gradient, double pressure) const;

    /// The pressure of the mixed form that belongs to a gradient and its
    /// stress, Cauchy's.
    double
    pressure(const dealii::Tensor<2, 3>          &gradient,
             const dealii::SymmetricTensor<2, 3> &stress) const;

    /// Twice the energy of Hooke's law with the moduli at small strains, per
    /// volume, of displacement and pressure; at finite strain of the
    /// logarithmic strain ln U in place of the linear one. With
    /// twice_energy_of_change() it makes the norm of relative errors for all
    /// laws: the energy norm of linear ones.
    double
    twice_energy(const dealii::Tensor<2, 3> &gradient, double pressure) const;

    /// The same of changes from @p gradient on, whose strain at finite strain is
    /// that of the deformed configuration, sym(change F^{-1}).
    double
    twice_energy_of_change(const dealii::Tensor<2, 3> &gradient,
                           const dealii::Tensor<2, 3> &change,
                           double                      pressure_change) const;

    /// s = 1 + @p thermal_strain of F = s F_e at finite strain, 1 at small strain.
    double
    thermal_stretch(double thermal_strain) const;

    /// @p gradient without @p thermal_strain, as laws take it.
    dealii::Tensor<2, 3>
    elastic_gradient(dealii::Tensor<2, 3> gradient,
                     double               thermal_strain) const;

    /// Of the elastic @p gradient: its trace, or ln J at finite strain.
    double
    dilatation(const dealii::Tensor<2, 3> &gradient) const;

    struct PressureDilatation
    {
      double value, slope;
    };

    /// The dilatation that belongs to the pressure @p p of the mixed form, and its
    /// derivative.
    PressureDilatation
    dilatation_of_pressure(double p) const;

    /// What a law makes of a deformation at one point.
    struct Response
    {
      dealii::SymmetricTensor<2, 3> cauchy;  ///< per deformed area
      dealii::Tensor<2, 3>          nominal; ///< P, per undeformed area
    };

    /// Of any law in any form; @p pressure is zero if not mixed, @p history what
    /// the point remembers, n_history() numbers of nonlinear(), or null if
    /// these are none.
    Response
    respond(const dealii::Tensor<2, 3> &gradient,
            double                      pressure,
            const double               *history = nullptr) const;

    /// The derivative of the nominal stress in the direction of a change of
    /// gradient and pressure, where points remember nothing.
    dealii::Tensor<2, 3>
    nominal_change(const dealii::Tensor<2, 3> &gradient,
                   double                      pressure,
                   const dealii::Tensor<2, 3> &change,
                   double                      pressure_change) const;

    /// Null if the law is linear; all else is of its tangent at small strains.
    const std::shared_ptr<const NonlinearLaw> &
    nonlinear() const
    {
      return nonlinear_law;
    }

    bool
    has_finite_strain() const;

    /// Null if the law has directions.
    const LinearElastic *
    isotropic() const
    {
      return std::get_if<LinearElastic>(&law);
    }

    bool
    mixed() const
    {
      return isotropic() && isotropic()->mixed;
    }

    bool
    incompressible() const
    {
      return isotropic() && isotropic()->incompressible();
    }

    /// See LinearElastic; only in mixed form.
    double
    compressibility() const
    {
      return std::get<LinearElastic>(law).compressibility();
    }

    double
    pressure_norm() const
    {
      return std::get<LinearElastic>(law).pressure_norm();
    }

    /// Isotropic laws between which the law lies in the mean over directions;
    /// every law has them.
    LinearElastic::Averages
    averages() const
    {
      return std::visit([](const auto &any) { return any.averages(); }, law);
    }

    /// Young's modulus of these: what differs from body to body by orders of
    /// magnitude.
    double
    softest_modulus() const
    {
      return averages().reuss.young_modulus;
    }

    double
    stiffest_modulus() const
    {
      return averages().voigt.young_modulus;
    }

    /// Their geometric mean.
    double
    modulus() const
    {
      return std::sqrt(softest_modulus() * stiffest_modulus());
    }

    /// The largest stiffness against plane waves by the smallest of any
    /// direction and polarisation, (lambda + 2 mu) / mu if isotropic.
    double
    stiffness_ratio() const;

  private:
    double
    hooke_energy(const dealii::Tensor<2, 3> &gradient, double pressure) const;

    std::variant<LinearElastic, Orthotropic> law;
    std::shared_ptr<const NonlinearLaw>      nonlinear_law;
  };
} // namespace mortise
