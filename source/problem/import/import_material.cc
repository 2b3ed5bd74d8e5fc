#include "import_material.h"

#include <deal.II/base/tensor.h>

#include <deal.II/physics/transformations.h>

#include <mortise/base/error.h>
#include <mortise/base/quotes.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace mortise
{
  using namespace dealii;

  std::vector<double>
  import_numbers(const InpLine &line, const std::size_t first)
  {
    std::vector<double> numbers;
    for (std::size_t i = first; i < line.words.size(); ++i)
      numbers.push_back(
        line.words[i].empty() ?
          0. :
          inp_number(line.words[i], [&](const std::string &what) {
            throw InputError("--import: the deck has in " + line.place + " " +
                             what);
          }));
    return numbers;
  }

  std::string
  angles_text(const Tensor<2, 3> &R)
  {
    // R = R_z R_y R_x
    const double y     = std::asin(std::max(-1., std::min(1., -R[2][0])));
    const bool   level = std::fabs(R[2][0]) < 1. - 1e-12;
    const double x     = level ? std::atan2(R[2][1], R[2][2]) : 0.;
    const double z =
      level ? std::atan2(R[1][0], R[0][0]) : std::atan2(-R[0][1], R[1][1]);
    std::string text;
    for (const double angle : {x, y, z})
      text +=
        (text.empty() ? "" : ", ") +
        number_text(std::fabs(angle) < 1e-14 ? 0. : angle * 180. / numbers::PI);
    return text;
  }

  Tensor<2, 3>
  axes_of(const Tensor<1, 3> &a,
          const Tensor<1, 3> &b,
          const std::string  &place)
  {
    Tensor<1, 3> z = cross_product_3d(a, b);
    if (!(z.norm() > 1e-12 * a.norm() * b.norm()))
      throw InputError("--import: the deck has in " + place +
                       " axes by two points on a line through the origin");
    const Tensor<1, 3> x = a / a.norm();
    z /= z.norm();
    const Tensor<1, 3> y = cross_product_3d(z, x);
    Tensor<2, 3>       axes;
    for (unsigned int d = 0; d < 3; ++d)
      {
        axes[d][0] = x[d];
        axes[d][1] = y[d];
        axes[d][2] = z[d];
      }
    return axes;
  }

  namespace
  {
    const std::set<std::string> material_keywords = {"*ELASTIC",
                                                     "*PLASTIC",
                                                     "*EXPANSION",
                                                     "*DENSITY",
                                                     "*HYPERELASTIC"};
    /// Of a material, and without a meaning in a static scene.
    const std::set<std::string> passed_over = {"*CONDUCTIVITY",
                                               "*SPECIFIC HEAT",
                                               "*DAMPING"};
    /// Of a material, and lost.
    const std::set<std::string> unknown = {"*CREEP",
                                           "*HYPERFOAM",
                                           "*USER MATERIAL",
                                           "*DEPVAR",
                                           "*CYCLIC HARDENING",
                                           "*DEFORMATION PLASTICITY",
                                           "*VISCOELASTIC",
                                           "*RATE DEPENDENT",
                                           "*DAMAGE INITIATION",
                                           "*DAMAGE EVOLUTION",
                                           "*VISCOUS",
                                           "*MOHR COULOMB",
                                           "*DRUCKER PRAGER",
                                           "*POTENTIAL"};

    std::string
    entry(const std::string &name, const std::string &value)
    {
      return "    set " + name + " = " + value + "\n";
    }

    std::string
    join_numbers(const std::vector<double> &numbers)
    {
      std::string text;
      for (const double number : numbers)
        text += (text.empty() ? "" : ", ") + number_text(number);
      return text;
    }

    /// Collects the text of one material from its keywords.
    class MaterialText
    {
    public:
      MaterialText(const std::string &name,
                   const bool         finite,
                   ImportRemarks     &remarks)
        : name(name)
        , finite(finite)
        , remarks(remarks)
      {}

      void
      add(const InpBlock &block)
      {
        if (block.lines.empty())
          throw InputError("--import: the deck has in " + block.place + " " +
                           block.keyword + " without numbers");
        if (block.keyword == "*DENSITY")
          result.density = import_numbers(block.lines[0])[0];
        else if (block.keyword == "*EXPANSION")
          expansion(block);
        else if (block.keyword == "*ELASTIC")
          elastic(block);
        else if (block.keyword == "*PLASTIC")
          plastic(block);
        else
          hyperelastic(block);
      }

      ImportMaterial
      finish(const std::string &axes)
      {
        if (young == 0. && text.empty())
          throw InputError(
            "--import: the material " + in_quotes(name, '\'') +
            " has no elastic constants that Mortise knows; allowed: *ELASTIC "
            "(isotropic, ENGINEERING CONSTANTS, ORTHO), *HYPERELASTIC (NEO "
            "HOOKE, MOONEY-RIVLIN, OGDEN)");
        if (young > 0.)
          {
            if (!yields.empty())
              result.text = entry("Law", "J2 plasticity");
            result.text += entry("Young modulus", number_text(young)) +
                           entry("Poisson ratio", number_text(poisson)) +
                           yields;
            if (finite)
              result.text += entry("Strain", "finite");
          }
        else
          {
            result.text = text + (is_orthotropic ? axes : "");
            if (finite && is_orthotropic)
              remarks.approximated(place,
                                   "orthotropic bodies have small strains, "
                                   "whatever NLGEOM says");
            if (!yields.empty())
              remarks.left_out(place,
                               "*PLASTIC of a material that is not isotropic");
          }
        result.nonlinear  = !yields.empty() || (young == 0. && !is_orthotropic);
        result.needs_more = result.nonlinear || poisson > 0.4;
        if (result.density > 0.)
          result.text += entry("Density", number_text(result.density));
        return result;
      }

    private:
      void
      tell_temperatures(const InpBlock &block, const std::size_t n)
      {
        if (block.lines.size() > n)
          remarks.approximated(block.lines[n].place,
                               block.keyword + " of " + name +
                                 " depends on the temperature; its first "
                                 "values are taken");
      }

      void
      expansion(const InpBlock &block)
      {
        const std::string kind = upper(block.option("TYPE"));
        if (!kind.empty() && kind != "ISO" && kind != "ISOTROPIC")
          return remarks.left_out(block.place,
                                  "*EXPANSION, TYPE=" + kind + " of " + name);
        result.expansion = import_numbers(block.lines[0])[0];
        tell_temperatures(block, 1);
      }

      void
      elastic(const InpBlock &block)
      {
        const std::string   kind = upper(block.option("TYPE"));
        std::vector<double> x;
        for (const InpLine &line : block.lines)
          for (const double number : import_numbers(line))
            x.push_back(number);
        place = block.place;
        if (kind.empty() || kind.rfind("ISO", 0) == 0)
          {
            x.resize(std::max<std::size_t>(x.size(), 2));
            young   = x[0];
            poisson = x[1];
            tell_temperatures(block, 1);
            return;
          }
        if (x.size() >= 9 && kind.rfind("ENGINEERING", 0) == 0)
          orthotropic({x[0], x[1], x[2]},
                      {x[3], x[5], x[4] * x[2] / x[0]},
                      {x[6], x[8], x[7]});
        else if (x.size() >= 9 && kind.rfind("ORTHO", 0) == 0)
          {
            Tensor<2, 3> D;
            D[0][0] = x[0];
            D[0][1] = D[1][0] = x[1];
            D[1][1]           = x[2];
            D[0][2] = D[2][0] = x[3];
            D[1][2] = D[2][1]    = x[4];
            D[2][2]              = x[5];
            const Tensor<2, 3> C = invert(D);
            orthotropic({1. / C[0][0], 1. / C[1][1], 1. / C[2][2]},
                        {-C[0][1] / C[0][0],
                         -C[1][2] / C[1][1],
                         -C[2][0] / C[2][2]},
                        {x[6], x[8], x[7]});
          }
        else
          return remarks.left_out(block.place,
                                  "*ELASTIC, TYPE=" + kind + " of " + name);
        tell_temperatures(block, 2);
      }

      void
      orthotropic(const std::vector<double> &E,
                  const std::vector<double> &nu,
                  const std::vector<double> &G)
      {
        is_orthotropic = true;
        text           = entry("Law", "orthotropic") +
               entry("Young moduli", join_numbers(E)) +
               entry("Poisson ratios", join_numbers(nu)) +
               entry("Shear moduli", join_numbers(G));
      }

      void
      plastic(const InpBlock &block)
      {
        const std::string kind = upper(block.option("HARDENING"));
        // stress, plastic strain, temperature: those of the first one
        std::vector<std::pair<double, double>> table;
        double                                 temperature = 0.;
        for (const InpLine &line : block.lines)
          {
            auto x = import_numbers(line);
            x.resize(3, table.empty() ? 0. : temperature);
            if (table.empty())
              temperature = x[2];
            if (x[2] == temperature)
              table.emplace_back(x[1], x[0]);
            else
              remarks.approximated(line.place,
                                   "*PLASTIC of " + name +
                                     " depends on the temperature; its first "
                                     "table is taken");
          }
        if (kind == "KINEMATIC" && table.size() == 2)
          {
            yields = entry("Yield stress", number_text(table[0].second)) +
                     entry("Kinematic hardening modulus",
                           number_text((table[1].second - table[0].second) /
                                       (table[1].first - table[0].first)));
            return;
          }
        if (!kind.empty() && kind != "ISOTROPIC")
          remarks.approximated(block.place,
                               "*PLASTIC, HARDENING=" + kind + " of " + name +
                                 " hardens isotropically");
        if (table.size() == 1)
          {
            yields = entry("Yield stress", number_text(table[0].second));
            return;
          }
        std::string points;
        for (const auto &[strain, stress] : table)
          points += (points.empty() ? "" : "; ") + number_text(strain) + ", " +
                    number_text(stress);
        yields = entry("Hardening table", points);
      }

      void
      hyperelastic(const InpBlock &block)
      {
        place                     = block.place;
        auto              x       = import_numbers(block.lines[0]);
        const std::string n_terms = block.option("N");
        const std::size_t n =
          n_terms.empty() ?
            1 :
            static_cast<std::size_t>(std::max(
              1., std::min(6., import_numbers({{n_terms}, block.place})[0])));
        const bool ogden  = block.has("OGDEN"),
                   mooney = block.has("MOONEY-RIVLIN") ||
                            (block.has("POLYNOMIAL") && n == 1);
        if ((!ogden && !mooney && !block.has("NEO HOOKE")) ||
            block.has("TEST DATA INPUT"))
          return remarks.left_out(block.place,
                                  "*HYPERELASTIC of " + name +
                                    " that is neither NEO HOOKE nor "
                                    "MOONEY-RIVLIN nor OGDEN");
        for (std::size_t i = 1; i < block.lines.size(); ++i)
          if (ogden)
            for (const double number : import_numbers(block.lines[i]))
              x.push_back(number);
        const std::size_t n_constants = ogden ? 2 * n : mooney ? 2 : 1;
        x.resize(std::max(x.size(), n_constants + 1));
        double shear = 0.; // of small strains
        if (ogden)
          {
            std::string terms;
            for (std::size_t p = 0; p < n; ++p)
              {
                const double mu = x[2 * p], alpha = x[2 * p + 1];
                terms += (terms.empty() ? "" : "; ") +
                         number_text(2. * mu / alpha) + ", " +
                         number_text(alpha);
                shear += mu;
              }
            text = entry("Law", "Ogden") + entry("Ogden terms", terms);
          }
        else
          {
            shear = 2. * (x[0] + (mooney ? x[1] : 0.));
            text =
              entry("Law", "Mooney-Rivlin") + entry("C10", number_text(x[0]));
            if (mooney)
              text += entry("C01", number_text(x[1]));
          }
        // K = 2 / D1
        const double D = x[n_constants];
        poisson = D > 0. ? (6. / D - 2. * shear) / (12. / D + 2. * shear) : 0.5;
        text += entry("Poisson ratio", number_text(poisson));
        remarks.approximated(block.place,
                             "*HYPERELASTIC of " + name +
                               ": the energy of the change of volume is "
                               "Mortise's, with the same bulk modulus");
      }

      const std::string name;
      const bool        finite;
      ImportRemarks    &remarks;
      ImportMaterial    result;
      std::string       text, yields, place;
      bool              is_orthotropic = false;
      double            young = 0., poisson = 0.;
    };
  } // namespace

  ImportMaterials::ImportMaterials(const InpDeck     &deck,
                                   const ImportSteps &steps,
                                   ImportRemarks     &remarks)
    : deck(deck)
    , finite(steps.finite)
  {
    std::string name;
    for (const InpBlock *block : steps.model)
      if (block->keyword == "*MATERIAL")
        {
          name = upper(block->option("NAME"));
          blocks[name];
        }
      else if (material_keywords.count(block->keyword) > 0)
        blocks[name].push_back(block);
      else if (unknown.count(block->keyword) > 0)
        remarks.left_out(block->place, block->keyword + " of " + name);
      else if (block->keyword == "*ORIENTATION")
        orientations[{block->instance, upper(block->option("NAME"))}] = block;
  }

  ImportMaterial
  ImportMaterials::of(const InpBlock &section, ImportRemarks &remarks) const
  {
    const std::string name  = upper(section.option("MATERIAL"));
    const auto        found = blocks.find(name);
    if (found == blocks.end())
      throw InputError("--import: the deck has in " + section.place +
                       " the material " + in_quotes(name, '\'') +
                       ", which it does not define");
    MaterialText text(name, finite, remarks);
    for (const InpBlock *block : found->second)
      text.add(*block);
    return text.finish(axes_text(section, remarks));
  }

  std::string
  ImportMaterials::axes_text(const InpBlock &section,
                             ImportRemarks  &remarks) const
  {
    Tensor<2, 3>      axes = unit_symmetric_tensor<3>();
    const std::string name = upper(section.option("ORIENTATION"));
    auto found = orientations.find({section.instance, name}); // of its part
    if (found == orientations.end())
      found = orientations.find({"", name});
    if (found == orientations.end() && !name.empty())
      throw InputError("--import: the deck has in " + section.place +
                       " the orientation " + in_quotes(name, '\'') +
                       ", which it does not define");
    if (found != orientations.end())
      {
        const InpBlock   &block  = *found->second;
        const std::string system = upper(block.option("SYSTEM"));
        auto              x      = block.lines.empty() ? std::vector<double>() :
                                                         import_numbers(block.lines[0]);
        if ((!system.empty() && system.rfind("R", 0) != 0) || x.size() < 6 ||
            x.size() > 6 || block.has("DEFINITION"))
          remarks.left_out(block.place,
                           "*ORIENTATION that is not RECTANGULAR with two "
                           "points; the axes are those of the scene");
        else
          axes = axes_of(Tensor<1, 3>({x[0], x[1], x[2]}),
                         Tensor<1, 3>({x[3], x[4], x[5]}),
                         block.place);
        // a further rotation about one of these axes
        const auto turn = block.lines.size() > 1 ?
                            import_numbers(block.lines[1]) :
                            std::vector<double>();
        if (turn.size() > 1 && turn[0] >= 1. && turn[0] < 4.)
          {
            Point<3> axis;
            axis[static_cast<unsigned int>(turn[0]) - 1] = 1.;
            axes =
              axes * Physics::Transformations::Rotations::rotation_matrix_3d(
                       axis, turn[1] * numbers::PI / 180.);
          }
      }
    if (const auto turned = deck.rotations.find(section.instance);
        turned != deck.rotations.end())
      axes = turned->second * axes;
    return entry("Axes", angles_text(axes));
  }
} // namespace mortise
