#include <mortise/base/error.h>
#include <mortise/base/numbers.h>
#include <mortise/base/quotes.h>
#include <mortise/material/factory.h>

#include <sstream>

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

    std::string
    text(const double value)
    {
      std::ostringstream stream;
      stream << value;
      return stream.str();
    }

    Material
    make_linear_elastic(const MaterialParameters &given,
                        const bool                mixed,
                        const Where              &where)
    {
      if (!given.young_modulus)
        fail(where("Young modulus"),
             "nothing with Law = linear elastic",
             "a positive number (force per area) " + allowed_moduli());
      const double E = *given.young_modulus, nu = given.poisson_ratio;
      if (!(E >= smallest_modulus && E <= largest_modulus))
        fail(where("Young modulus"),
             text(E),
             "a positive number (force per area) " + allowed_moduli());
      if (!(nu > -1. && nu <= 0.5))
        fail(
          where("Poisson ratio"),
          text(nu),
          "a number above -1 and not above 0.5 (at 0.5 a body is incompressible)");
      return LinearElastic{E, nu, mixed};
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

    /// Which constants are not at their defaults.
    struct Constant
    {
      const char *name;
      bool        given;
    };

    std::vector<Constant>
    linear_elastic_constants(const MaterialParameters &given)
    {
      const MaterialParameters none;
      return {{"Young modulus", given.young_modulus.has_value()},
              {"Poisson ratio", given.poisson_ratio != none.poisson_ratio}};
    }

    std::vector<Constant>
    orthotropic_constants(const MaterialParameters &given)
    {
      const Orthotropic &law = given.orthotropic, none;
      return {{"Young moduli", law.young_moduli != none.young_moduli},
              {"Poisson ratios", law.poisson_ratios != none.poisson_ratios},
              {"Shear moduli", law.shear_moduli != none.shear_moduli},
              {"Axes", law.axes != none.axes}};
    }

    struct Entry
    {
      const char *name;
      Material (*make)(const MaterialParameters &, bool mixed, const Where &);
      std::vector<Constant> (*constants)(const MaterialParameters &);
    };

    const std::vector<Entry> laws = {
      {"linear elastic", make_linear_elastic, linear_elastic_constants},
      {"orthotropic", make_orthotropic, orthotropic_constants}};
  } // namespace

  std::vector<std::string>
  law_names()
  {
    std::vector<std::string> names;
    for (const Entry &law : laws)
      names.push_back(law.name);
    return names;
  }

  Material
  make_material(const MaterialParameters &parameters,
                const bool                mixed,
                const Where              &where)
  {
    const Entry *chosen = nullptr;
    for (const Entry &law : laws)
      if (parameters.law == law.name)
        chosen = &law;
    if (chosen == nullptr)
      fail(where("Law"),
           in_quotes(parameters.law),
           "one of: " + join_names(law_names()));
    for (const Entry &other : laws)
      if (&other != chosen)
        for (const Constant &constant : other.constants(parameters))
          if (constant.given)
            {
              std::vector<std::string> own;
              for (const Constant &any : chosen->constants(parameters))
                own.push_back(any.name);
              throw InputError(where(constant.name) +
                               ": belongs to Law = " + other.name +
                               ", but the body has Law = " + parameters.law +
                               "; allowed with it: " + join_names(own));
            }
    if (!(parameters.density == 0. || (parameters.density >= smallest_number &&
                                       parameters.density <= largest_number)))
      fail(where("Density"),
           text(parameters.density),
           "0 or a positive number (mass per volume) " + allowed_numbers());
    return chosen->make(parameters, mixed, where);
  }
} // namespace mortise
