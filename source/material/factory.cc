#include <mortise/base/error.h>
#include <mortise/base/numbers.h>
#include <mortise/base/quotes.h>
#include <mortise/material/factory.h>
#include <mortise/material/invariant_laws.h>

#include <algorithm>
#include <cstring>

namespace mortise
{
  namespace
  {
    using Where = std::function<std::string(const std::string &name)>;

    [[noreturn]] void
    fail(const std::string &where,
         const std::string &got,
         const std::string &allowed)
    {
      throw InputError(where + ": got " + got + "; allowed: " + allowed);
    }

    constexpr const char *modulus_words = "a positive number (force per area) ";

    bool
    is_modulus(const double value)
    {
      return value >= smallest_modulus && value <= largest_modulus;
    }

    void
    check_poisson_ratio(const MaterialParameters &given,
                        const bool                may_be_incompressible,
                        const Where              &where)
    {
      const double nu = given.poisson_ratio;
      if (!(nu > -1. && (may_be_incompressible ? nu <= 0.5 : nu < 0.5)))
        fail(
          where("Poisson ratio"),
          text_of(nu),
          may_be_incompressible ?
            "a number above -1 and not above 0.5 (at 0.5 a body is incompressible)" :
            "a number above -1 and below 0.5");
    }

    /// Hooke's law of small strains from Young modulus and Poisson ratio.
    LinearElastic
    hooke(const MaterialParameters &given,
          const bool                mixed,
          const bool                may_be_incompressible,
          const Where              &where)
    {
      if (!given.young_modulus)
        fail(where("Young modulus"),
             "nothing with Law = " + given.law,
             modulus_words + allowed_moduli());
      if (!is_modulus(*given.young_modulus))
        fail(where("Young modulus"),
             text_of(*given.young_modulus),
             modulus_words + allowed_moduli());
      check_poisson_ratio(given, may_be_incompressible, where);
      return {*given.young_modulus, given.poisson_ratio, mixed};
    }

    double
    compressibility(const LinearElastic &law)
    {
      return law.mixed ? law.compressibility() : 0.;
    }

    Material
    make_linear_elastic(const MaterialParameters &given,
                        const bool                mixed,
                        const Where              &where)
    {
      const LinearElastic law = hooke(given, mixed, true, where);
      if (!is_finite(given))
        return law;
      return {law,
              std::make_shared<Hencky>(law.displacement_lambda(),
                                       law.lame_mu(),
                                       compressibility(law))};
    }

    Material
    make_neo_hookean(const MaterialParameters &given,
                     const bool                mixed,
                     const Where              &where)
    {
      const LinearElastic law = hooke(given, mixed, true, where);
      return {law,
              std::make_shared<NeoHookean>(law.displacement_lambda(),
                                           law.lame_mu(),
                                           compressibility(law))};
    }

    Material
    make_st_venant_kirchhoff(const MaterialParameters &given,
                             const bool,
                             const Where &where)
    {
      const LinearElastic law = hooke(given, false, false, where);
      return {law,
              std::make_shared<StVenantKirchhoff>(law.lame_lambda(),
                                                  law.lame_mu())};
    }

    /// The law of small strains with a shear modulus.
    LinearElastic
    hooke_of_shear(const MaterialParameters &given,
                   const double              shear_modulus,
                   const bool                mixed)
    {
      const double nu = given.poisson_ratio;
      return {2. * (1. + nu) * shear_modulus, nu, mixed};
    }

    Material
    make_mooney_rivlin(const MaterialParameters &given,
                       const bool                mixed,
                       const Where              &where)
    {
      if (!(given.c10 >= 0.))
        fail(where("C10"), text_of(given.c10), "0 or a positive number");
      if (!(given.c01 >= 0.))
        fail(where("C01"), text_of(given.c01), "0 or a positive number");
      if (!is_modulus(given.c10 + given.c01))
        fail(where("C10"),
             "C10 + C01 = " + text_of(given.c10 + given.c01),
             modulus_words + allowed_moduli());
      check_poisson_ratio(given, true, where);
      const LinearElastic law =
        hooke_of_shear(given, 2. * (given.c10 + given.c01), mixed);
      return {law,
              std::make_shared<MooneyRivlin>(VolumetricLaw(law),
                                             given.c10,
                                             given.c01)};
    }

    Material
    make_ogden_of_terms(const MaterialParameters &given,
                        const bool                mixed,
                        const Where              &where)
    {
      const std::string allowed =
        "\"mu_1, alpha_1; mu_2, alpha_2; ...\" with mu_p alpha_p > 0, half the sum of which is the shear modulus";
      if (given.ogden_terms.empty())
        fail(where("Ogden terms"), "nothing with Law = Ogden", allowed);
      for (const Ogden::Term &term : given.ogden_terms)
        if (!(term.modulus * term.exponent > 0.) ||
            !is_modulus(term.modulus * term.exponent))
          fail(where("Ogden terms"),
               text_of(term.modulus) + ", " + text_of(term.exponent),
               allowed);
      check_poisson_ratio(given, true, where);
      const LinearElastic law =
        hooke_of_shear(given, Ogden::shear_modulus(given.ogden_terms), mixed);
      return {law,
              std::make_shared<Ogden>(VolumetricLaw(law), given.ogden_terms)};
    }

    Material
    make_plasticity(const MaterialParameters &given,
                    const bool                mixed,
                    const Where              &where)
    {
      const LinearElastic law = hooke(given, mixed, true, where);
      if (const auto defect = given.hardening.defect())
        fail(where(defect->constant), defect->got, defect->allowed);
      const Plasticity plasticity(law.displacement_lambda() +
                                    2. / 3. * law.lame_mu(),
                                  law.lame_mu(),
                                  given.hardening,
                                  compressibility(law));
      if (is_finite(given))
        return {law, std::make_shared<FinitePlasticity>(plasticity)};
      return {law, std::make_shared<Plasticity>(plasticity)};
    }

    Material
    make_orthotropic(const MaterialParameters &given,
                     const bool,
                     const Where &where)
    {
      if (const auto defect = given.orthotropic.defect())
        fail(where(defect->constant), defect->got, defect->allowed);
      return given.orthotropic;
    }

    Material
    make_rigid(const MaterialParameters &, const bool, const Where &)
    {
      return LinearElastic{1., 0., false};
    }

    /// A constant of laws, and whether it is not at its default.
    struct Constant
    {
      const char *name;
      bool        given;
    };

    std::vector<Constant>
    all_constants(const MaterialParameters &given)
    {
      const MaterialParameters none;
      const Orthotropic &law = given.orthotropic, &no_law = none.orthotropic;
      const Hardening   &hardening = given.hardening;
      return {{"Young modulus", given.young_modulus.has_value()},
              {"Poisson ratio", given.poisson_ratio != none.poisson_ratio},
              {"C10", given.c10 != 0.},
              {"C01", given.c01 != 0.},
              {"Ogden terms", !given.ogden_terms.empty()},
              {"Yield stress", hardening.yield_stress != 0.},
              {"Hardening modulus", hardening.modulus != 0.},
              {"Saturation stress", hardening.saturation_stress != 0.},
              {"Saturation exponent", hardening.saturation_exponent != 0.},
              {"Kinematic hardening modulus",
               hardening.kinematic_modulus != 0.},
              {"Hardening table", !hardening.table.empty()},
              {"Young moduli", law.young_moduli != no_law.young_moduli},
              {"Poisson ratios", law.poisson_ratios != no_law.poisson_ratios},
              {"Shear moduli", law.shear_moduli != no_law.shear_moduli},
              {"Axes", law.axes != no_law.axes}};
    }

    struct Entry
    {
      const char *name;
      Material (*make)(const MaterialParameters &, bool mixed, const Where &);
      bool                      may_be_small, may_be_finite, may_be_mixed;
      std::vector<const char *> constants;

      bool
      takes(const char *constant) const
      {
        return std::any_of(constants.begin(),
                           constants.end(),
                           [&](const char *own) {
                             return std::strcmp(own, constant) == 0;
                           });
      }
    };

    constexpr const char *rigid = "rigid";

    const std::vector<Entry> laws = {
      {"linear elastic",
       make_linear_elastic,
       true,
       true,
       true,
       {"Young modulus", "Poisson ratio"}},
      {"orthotropic",
       make_orthotropic,
       true,
       false,
       false,
       {"Young moduli", "Poisson ratios", "Shear moduli", "Axes"}},
      {"neo-Hookean",
       make_neo_hookean,
       false,
       true,
       true,
       {"Young modulus", "Poisson ratio"}},
      {"Mooney-Rivlin",
       make_mooney_rivlin,
       false,
       true,
       true,
       {"C10", "C01", "Poisson ratio"}},
      {"Ogden",
       make_ogden_of_terms,
       false,
       true,
       true,
       {"Ogden terms", "Poisson ratio"}},
      {"St. Venant-Kirchhoff",
       make_st_venant_kirchhoff,
       false,
       true,
       false,
       {"Young modulus", "Poisson ratio"}},
      {"J2 plasticity",
       make_plasticity,
       true,
       true,
       true,
       {"Young modulus",
        "Poisson ratio",
        "Yield stress",
        "Hardening modulus",
        "Saturation stress",
        "Saturation exponent",
        "Kinematic hardening modulus",
        "Hardening table"}},
      {rigid, make_rigid, true, false, false, {}}};

    const Entry *
    find(const std::string &name)
    {
      for (const Entry &law : laws)
        if (name == law.name)
          return &law;
      return nullptr;
    }

    void
    check_constants(const MaterialParameters &given,
                    const Entry              &chosen,
                    const Where              &where)
    {
      for (const Constant &constant : all_constants(given))
        if (constant.given && !chosen.takes(constant.name))
          {
            std::vector<std::string> owners;
            for (const Entry &law : laws)
              if (law.takes(constant.name))
                owners.push_back(law.name);
            throw InputError(
              where(constant.name) +
              ": belongs to Law = " + join_names(owners) +
              ", but the body has Law = " + given.law + "; allowed with it: " +
              join_names(std::vector<std::string>(chosen.constants.begin(),
                                                  chosen.constants.end())));
          }
    }

    void
    check_strain(const MaterialParameters &given,
                 const Entry              &chosen,
                 const Where              &where)
    {
      if (given.strain == StrainMeasure::small && !chosen.may_be_small)
        fail(where("Strain"), "small with Law = " + given.law, "finite");
      if (given.strain == StrainMeasure::finite && !chosen.may_be_finite)
        fail(where("Strain"), "finite with Law = " + given.law, "small");
    }
  } // namespace

  std::vector<std::string>
  law_names()
  {
    std::vector<std::string> names;
    for (const Entry &law : laws)
      names.push_back(law.name);
    return names;
  }

  bool
  has_mixed_form(const std::string &law)
  {
    const Entry *entry = find(law);
    return entry != nullptr && entry->may_be_mixed;
  }

  bool
  is_finite(const MaterialParameters &parameters)
  {
    const Entry *entry = find(parameters.law);
    return parameters.strain == StrainMeasure::finite ||
           (parameters.strain == StrainMeasure::automatic && entry != nullptr &&
            !entry->may_be_small);
  }

  bool
  is_rigid(const MaterialParameters &parameters)
  {
    return parameters.law == rigid;
  }

  bool
  is_linear(const MaterialParameters &parameters)
  {
    return (parameters.law == "linear elastic" ||
            parameters.law == "orthotropic" || is_rigid(parameters)) &&
           !is_finite(parameters);
  }

  Material
  make_material(const MaterialParameters &parameters,
                const bool                mixed,
                const Where              &where)
  {
    const Entry *chosen = find(parameters.law);
    if (chosen == nullptr)
      fail(where("Law"),
           in_quotes(parameters.law),
           "one of: " + join_names(law_names()));
    check_constants(parameters, *chosen, where);
    check_strain(parameters, *chosen, where);
    if (!(parameters.density == 0. || (parameters.density >= smallest_number &&
                                       parameters.density <= largest_number)))
      fail(where("Density"),
           text_of(parameters.density),
           "0 or a positive number (mass per volume) " + allowed_numbers());
    return chosen->make(parameters, mixed, where);
  }
} // namespace mortise
