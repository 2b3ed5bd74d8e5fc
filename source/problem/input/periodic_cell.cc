// See periodic_cell.h, and InterfaceParameters::placement().
#include <deal.II/lac/lapack_full_matrix.h>

#include <mortise/base/error.h>
#include <mortise/base/quotes.h>
#include <mortise/base/rigid_motion.h>
#include <mortise/problem/input/periodic_cell.h>

#include <algorithm>
#include <cmath>

#include "parameter_checks.h"

namespace mortise
{
  using namespace dealii;

  namespace
  {
    Tensor<1, 3>
    vector_of(const std::array<double, 3> &numbers)
    {
      return Tensor<1, 3>({numbers[0], numbers[1], numbers[2]});
    }

    bool
    are_same(const Tensor<1, 3> &a, const Tensor<1, 3> &b)
    {
      constexpr double rounding = 1e-9;
      return std::min((a - b).norm(), (a + b).norm()) <= rounding * a.norm();
    }

    /// Translation and Rotation with what they need, and nothing else.
    void
    check_motion(const Parameters          &parameters,
                 const InterfaceParameters &interface)
    {
      const std::string section = interface.path();
      const auto        check   = [&](const std::string &name,
                             const auto        &given,
                             const Periodicity  of,
                             const std::string &kind,
                             const std::string &allowed) {
        const std::string path = section + "/" + name;
        if (interface.periodic != of)
          {
            if (given)
              parameters.fail(path,
                              "a " + kind + " without Periodic = " + kind,
                              "nothing");
            return;
          }
        if (!given)
          parameters.fail(path, "nothing with Periodic = " + kind, allowed);
        if (vector_of(*given).norm() == 0.)
          parameters.fail(path, "zero", allowed);
      };
      check("Translation",
            interface.translation,
            Periodicity::translation,
            "translation",
            "the vector from the master to the slave");
      check(
        "Rotation",
        interface.rotation,
        Periodicity::rotation,
        "rotation",
        "the rotation from the master to the slave, a vector along the axis, in degrees");
      if (interface.reference_point &&
          interface.periodic != Periodicity::rotation)
        parameters.fail(section + "/Reference point",
                        "a point without Periodic = rotation",
                        "nothing");
      if (interface.periodic == Periodicity::none)
        return;
      if (interface.law != Law::tie)
        parameters.fail(section + "/Periodic",
                        "a periodic interface with Law = " +
                          name_of(interface.law),
                        "Law = tie");
      if (interface.preload)
        parameters.fail(
          section + "/Preload",
          "a preload of a periodic interface",
          "nothing; the Mean stress of the Periodic cell acts on all of it");
    }

    /// The squares of jumps of the free components, over the translations,
    /// have no zero but zero.
    bool
    move_translations(const std::vector<unsigned int> &free,
                      const std::vector<Tensor<1, 3>> &moved)
    {
      LAPACKFullMatrix<double> squares(free.size(), free.size());
      for (unsigned int a = 0; a < free.size(); ++a)
        for (unsigned int b = 0; b < free.size(); ++b)
          {
            double sum = 0.;
            for (const Tensor<1, 3> &t : moved)
              sum += (unit_strain(free[a]) * t) * (unit_strain(free[b]) * t) /
                     t.norm_square();
            squares(a, b) = sum;
          }
      squares.compute_svd();
      return squares.singular_value(free.size() - 1) > 1e-9;
    }
  } // namespace

  RigidMotion
  InterfaceParameters::placement() const
  {
    RigidMotion result;
    if (periodic == Periodicity::translation)
      result.translation = vector_of(*translation);
    if (periodic == Periodicity::rotation)
      {
        const Tensor<1, 3> centre =
          vector_of(reference_point.value_or(std::array<double, 3>{}));
        result.rotation =
          rotation_by(numbers::PI / 180. * vector_of(*rotation));
        result.translation = centre - result.rotation * centre;
      }
    return result;
  }

  Tensor<2, 3>
  unit_strain(const unsigned int component)
  {
    Tensor<2, 3> result;
    if (component < 3)
      result[component][component] = 1.;
    else
      {
        const unsigned int i = (component - 3 + 1) % 3, j = (i + 1) % 3;
        result[i][j] = result[j][i] = 1.;
      }
    return result;
  }

  std::vector<Tensor<1, 3>>
  translations(const Parameters &parameters)
  {
    std::vector<Tensor<1, 3>> result;
    for (const InterfaceParameters &interface : parameters.interfaces)
      if (interface.periodic == Periodicity::translation)
        {
          const Tensor<1, 3> t = vector_of(*interface.translation);
          if (std::none_of(result.begin(),
                           result.end(),
                           [&](const auto &other) {
                             return are_same(t, other);
                           }))
            result.push_back(t);
        }
    return result;
  }

  double
  cell_volume(const Parameters &parameters)
  {
    constexpr double rounding = 1e-9;
    const auto       all      = translations(parameters);
    double           least    = 0.;
    for (unsigned int i = 0; i < all.size(); ++i)
      for (unsigned int j = 0; j < i; ++j)
        for (unsigned int k = 0; k < j; ++k)
          {
            const double volume =
              std::fabs(cross_product_3d(all[i], all[j]) * all[k]);
            if (volume >
                  rounding * all[i].norm() * all[j].norm() * all[k].norm() &&
                (least == 0. || volume < least))
              least = volume;
          }
    return least;
  }

  bool
  is_free_strain(const Parameters &parameters, const unsigned int component)
  {
    return parameters.mean_strain[component] == "free";
  }

  bool
  has_free_strain(const Parameters &parameters)
  {
    const auto &all = parameters.mean_strain;
    return std::find(all.begin(), all.end(), "free") != all.end();
  }

  bool
  has_free_volume(const Parameters &parameters)
  {
    return is_free_strain(parameters, 0) || is_free_strain(parameters, 1) ||
           is_free_strain(parameters, 2);
  }

  void
  check_periodic_cell(const Parameters &parameters)
  {
    for (const InterfaceParameters &interface : parameters.interfaces)
      if (!interface.is_support)
        check_motion(parameters, interface);
    const std::string strain        = "Periodic cell/Mean strain",
                      stress        = "Periodic cell/Mean stress";
    const auto                moved = translations(parameters);
    std::vector<unsigned int> free;
    for (unsigned int k = 0; k < parameters.mean_strain.size(); ++k)
      {
        const std::string component =
          std::string(", component ") + components_of_strain[k];
        const std::string &of_strain = parameters.mean_strain[k],
                          &of_stress = parameters.mean_stress[k];
        check_number(parameters, stress, of_stress, component);
        if (is_free_strain(parameters, k))
          free.push_back(k);
        else
          {
            check_number(parameters, strain, of_strain, component);
            if (of_stress != "0")
              parameters.fail(
                stress + component,
                in_quotes(of_stress) + " beside the Mean strain " +
                  in_quotes(of_strain),
                "0, or \"free\" for that component of Mean strain");
          }
        if (moved.empty() && of_strain != "0")
          parameters.fail(
            strain,
            in_quotes(of_strain) + component +
              ", in a scene where no interface has Periodic = translation",
            "0: a mean strain acts on translations");
      }
    if (!free.empty() && !move_translations(free, moved))
      parameters.fail(strain,
                      "more free components than the " +
                        std::to_string(moved.size()) +
                        " different translations of the interfaces can tell",
                      "\"free\" for components along the translations");
  }
} // namespace mortise
