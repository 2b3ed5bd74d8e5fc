// Materials by the name of their law.
#pragma once

#include <mortise/material/material.h>
#include <mortise/material/plasticity.h>
#include <mortise/material/principal_laws.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace mortise
{
  enum class StrainMeasure
  {
    automatic, ///< finite for hyperelastic laws, else small
    small,
    finite
  };

  /// A law and the constants of all laws, of which it takes its own.
  struct MaterialParameters
  {
    std::string           law    = "linear elastic";
    StrainMeasure         strain = StrainMeasure::automatic;
    std::optional<double> young_modulus; ///< force per area; none stands for it
    double                poisson_ratio = 0.3; ///< -1 < nu <= 0.5
    double                c10 = 0., c01 = 0.;  ///< force per area
    std::vector<Ogden::Term> ogden_terms;
    Hardening                hardening;
    Orthotropic              orthotropic;
    double density = 0.; ///< of any law, mass per volume; 0: none
    /// Of any law, strain per temperature, the same in all directions.
    double thermal_expansion = 0.;
  };

  /// Names of the laws.
  std::vector<std::string>
  law_names();

  /// Has the law a mixed form?
  bool
  has_mixed_form(const std::string &law);

  /// Does the law take finite strains?
  bool
  is_finite(const MaterialParameters &parameters);

  /// Does the body move as a rigid part?
  bool
  is_rigid(const MaterialParameters &parameters);

  /// Is the stress linear in the gradient of the displacement?
  bool
  is_linear(const MaterialParameters &parameters);

  /// Throws InputError for a law that does not exist, listing those that do,
  /// for constants with which it is none, and for those of another law that are
  /// not left at their defaults; @p where is the place of a parameter of the
  /// material by its name, for messages. A rigid body has a material all the
  /// same, of any modulus, which never is strained.
  Material
  make_material(
    const MaterialParameters                                  &parameters,
    bool                                                       mixed,
    const std::function<std::string(const std::string &name)> &where);
} // namespace mortise
