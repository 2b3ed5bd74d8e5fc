// Plasticity of von Mises (J2) with isotropic and kinematic hardening, at small
// strain and in logarithmic strains at finite strain. Sources: Simo, Hughes,
// Computational Inelasticity, sections 3.3 (radial return, consistent tangent);
// Miehe, Apel, Lambrecht (2002).
#pragma once

#include <mortise/material/constant_defect.h>
#include <mortise/material/logarithmic_law.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mortise
{
  /// The yield stress as a function of the equivalent plastic strain alpha,
  ///
  ///     sigma_y = sigma_0 + H alpha + (sigma_s - sigma_0) (1 - exp(-delta
  ///     alpha)),
  ///
  /// or linear between the points of a table and constant beyond its last.
  struct Hardening
  {
    double yield_stress        = 0.; ///< sigma_0, force per area
    double modulus             = 0.; ///< H, force per area
    double saturation_stress   = 0.; ///< sigma_s, force per area; 0: none
    double saturation_exponent = 0.; ///< delta
    double kinematic_modulus   = 0.; ///< of Prager's law, force per area
    /// Plastic strains, ascending from 0, and yield stresses; in place of the
    /// others but the kinematic modulus.
    std::vector<std::pair<double, double>> table;

    std::optional<ConstantDefect>
    defect() const;

    /// Set @p value = sigma_y(alpha) and @p slope, its derivative.
    void
    evaluate(const DoubleBatch &alpha,
             DoubleBatch       &value,
             DoubleBatch       &slope) const;

  private:
    std::optional<ConstantDefect>
    defect_of_table() const;
  };

  /// At small strain. The history: the plastic strain as xx, yy, zz, yz, zx, xy
  /// of the tensor, then alpha.
  class Plasticity : public NonlinearLaw
  {
  public:
    /// Of the elastic bulk and shear modulus, force per area; @p compressibility:
    /// see NonlinearLaw.
    Plasticity(const double     bulk_modulus,
               const double     shear_modulus,
               const Hardening &hardening,
               const double     compressibility = 0.)
      : NonlinearLaw(compressibility)
      , K(bulk_modulus)
      , G(shear_modulus)
      , hardening(hardening)
    {}

    static constexpr unsigned int n_numbers = 7;

    TangentForm
    form() const override
    {
      return TangentForm::rank_one;
    }

    unsigned int
    n_history() const override
    {
      return n_numbers;
    }

    std::optional<unsigned int>
    plastic_strain() const override
    {
      return n_numbers - 1;
    }

    void
    stress(const V (&h)[3][3],
           const V *before,
           V       *after,
           V (&s)[3][3]) const override;

    void
    tangent(const V (&h)[3][3], const V *before, V *moduli) const override;

  private:
    /// The return to the yield surface from the trial stress.
    struct Return
    {
      V relative[6]; ///< trial of the deviatoric stress less the back stress
      V size;        ///< its norm
      V dilatation;  ///< tr e
      V flow;        ///< Delta gamma, 0 where elastic
      V slope;       ///< d sigma_y / d alpha after it
    };

    Return
    return_from(const V (&h)[3][3], const V *before) const;

    const double    K, G;
    const Hardening hardening;
  };

  /// The same in the logarithmic strain.
  class FinitePlasticity : public LogarithmicLaw
  {
  public:
    explicit FinitePlasticity(const Plasticity &law)
      : law(law)
    {}

    void
    dilatation_of_pressure(const V &p, V &value, V &slope) const override
    {
      law.dilatation_of_pressure(p, value, slope);
    }

    unsigned int
    n_history() const override
    {
      return law.n_history();
    }

    std::optional<unsigned int>
    plastic_strain() const override
    {
      return law.plastic_strain();
    }

  protected:
    void
    stress_in_axes(const Strain &strain,
                   const V      *before,
                   V            *after,
                   V (&T)[3][3]) const override;

    void
    moduli_in_axes(const Strain &strain,
                   const V      *before,
                   V (&T)[3][3],
                   V (&D)[6][6]) const override;

  private:
    const Plasticity law;
  };
} // namespace mortise
