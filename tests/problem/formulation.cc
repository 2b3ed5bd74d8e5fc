// Proves which bodies take the mixed form by themselves, and that every form
// which does not exist with the rest of a scene gives one message with what,
// where, what was got and what is allowed.
#include <mortise/problem/input/formulation.h>

#include "parameter_checks.h"

using namespace parameter_checks;

namespace
{
  bool
  mixed(const double                                nu,
        const unsigned int                          degree,
        const std::map<unsigned int, unsigned int> &regions = {},
        const Formulation formulation = Formulation::automatic)
  {
    BodyParameters body;
    body.degree                 = degree;
    body.degree_by_region       = regions;
    body.material.poisson_ratio = nu;
    body.formulation            = formulation;
    return is_mixed(body);
  }

  /// The scene with nu and the degrees of the inner body replaced.
  Parameters
  scene_with(const std::string &nu, const Settings &settings)
  {
    Settings all = {"Body inner/Material/Poisson ratio=" + nu,
                    "Body inner/Degree by region="};
    all.insert(all.end(), settings.begin(), settings.end());
    return parse_parameters(scene, "a.prm", all);
  }

  void
  check(const std::string              &what,
        const std::string              &nu,
        const Settings                 &settings,
        const std::vector<std::string> &parts)
  {
    check_message(
      what, [&] { validate(scene_with(nu, settings)); }, parts);
  }
} // namespace

int
main()
{
  verdict(!mixed(0.489, 2), "displacement below 0.49");
  verdict(mixed(0.49, 2), "mixed from 0.49 on");
  verdict(!mixed(0.49, 1), "displacement at degree 1");
  verdict(!mixed(0.49, 2, {{3, 1}}),
          "displacement where a region has degree 1");
  verdict(mixed(0.5, 1), "mixed at 0.5 whatever the degree");
  verdict(mixed(0.3, 2, {}, Formulation::mixed), "mixed when asked for");
  verdict(!mixed(0.499, 2, {}, Formulation::displacement),
          "displacement when asked for");
  const auto first_degree = [](const std::string &nu, Settings settings) {
    settings.push_back("Body inner/Degree=1");
    return scene_with(nu, settings).bodies[0].degree;
  };
  const Settings target = {"Adaptivity/Target error=0.1"};
  verdict(first_degree("0.49", target) == 2,
          "cycles begin with the mixed form at 0.49");
  verdict(first_degree("0.48", target) == 1, "and with degree 1 below");
  verdict(first_degree("0.49", {}) == 1, "and without a target");
  verdict(first_degree("0.49",
                       {target[0], "Body inner/Formulation=displacement"}) == 1,
          "and in displacement form when asked for");
  check_message("0.5 is allowed",
                [] { validate(scene_with("0.5", {})); },
                {"(no error)"});
  check("an unknown form",
        "0.3",
        {"Body inner/Formulation=mixd"},
        {"Body inner/Formulation", "mixd", "auto, displacement, mixed"});
  check("displacement form at 0.5",
        "0.5",
        {"Body inner/Formulation=displacement"},
        {"Body inner/Formulation (--set",
         "displacement",
         "Poisson ratio 0.5",
         "allowed: mixed or auto"});
  check("degree 1 at 0.5",
        "0.5",
        {"Body inner/Degree=1"},
        {"Body inner/Degree (--set", "degree 1", "degrees from 2 to 8"});
  check("degree 1 in a region at 0.5",
        "0.5",
        {"Body inner/Degree by region=3: 1"},
        {"Body inner/Degree by region (--set",
         "degree 1",
         "degrees from 2 to 8"});
  check("mixed form at 0",
        "0",
        {"Body inner/Formulation=mixed"},
        {"Body inner/Formulation (--set", "Poisson ratio 0", "displacement"});
  check("conjugate gradients in mixed form",
        "0.5",
        {"Solver/Method=condensed"},
        {"Solver/Method (--set", "inner", "auto, saddle point, direct"});
  check("a pressure beside a named solution",
        "0.5",
        {"Exact solution/Pressure=1"},
        {"Exact solution/Pressure (--set", "allowed: nothing"});
  const std::string outer       = "Body outer/Material/";
  const Settings    orthotropic = {outer + "Law=orthotropic",
                                   outer + "Young modulus=",
                                   outer + "Young moduli=10, 1, 1",
                                   outer + "Poisson ratios=0.3, 0.4, 0.03",
                                   outer + "Shear moduli=1, 1, 1"};
  const auto        with        = [&](const Settings &settings) {
    Settings all = orthotropic;
    all.insert(all.end(), settings.begin(), settings.end());
    return all;
  };
  check("orthotropic is allowed", "0.3", orthotropic, {"(no error)"});
  check("a law that does not exist",
        "0.3",
        {outer + "Law=orthotropc"},
        {outer + "Law (--set",
         "orthotropc",
         "linear elastic, orthotropic, neo-Hookean"});
  check("orthotropic without constants",
        "0.3",
        {outer + "Law=orthotropic", outer + "Young modulus="},
        {outer + "Young moduli", "got 0", "three positive numbers"});
  check("constants of another law",
        "0.3",
        with({outer + "Young modulus=3"}),
        {outer + "Young modulus (--set",
         "belongs to Law = linear elastic, neo-Hookean",
         "Law = orthotropic",
         "Young moduli, Poisson ratios, Shear moduli, Axes"});
  check("orthotropic constants without the law",
        "0.3",
        {outer + "Axes=0, 0, 90"},
        {outer + "Axes (--set",
         "belongs to Law = orthotropic",
         "Young modulus, Poisson ratio"});
  check("two of three moduli",
        "0.3",
        with({outer + "Young moduli=10, 1"}),
        {outer + "Young moduli (--set", "3 positive numbers"});
  check("a stiffness that is not positive definite",
        "0.3",
        with({outer + "Poisson ratios=0.3, 1.2, 0"}),
        {outer + "Poisson ratios (--set", "nu_yz = 1.2", "|nu_yz| < 1"});
  check("mixed form of another law",
        "0.3",
        with({"Body outer/Formulation=mixed"}),
        {"Body outer/Formulation (--set",
         "\"mixed\" with Law = orthotropic",
         "the law has no mixed form"});
  const Settings stiff = with({outer + "Young moduli=1, 1, 1",
                               outer + "Poisson ratios=0.495, 0.495, 0.495"});
  check("another law nearly incompressible",
        "0.3",
        stiff,
        {"Body outer/Formulation",
         "nearly incompressible",
         "Poisson ratio 0.49",
         "the law has no mixed form"});
  Settings locking = stiff;
  locking.push_back("Body outer/Formulation=displacement");
  check("the same in displacement form", "0.3", locking, {"(no error)"});
  const std::string field = "Exact solution/Displacement=x; -y; 0";
  check("no pressure for an expression at 0.5",
        "0.5",
        {field},
        {"Exact solution/Pressure", "got nothing", "mean pressure"});
  check("a pressure that does not parse",
        "0.5",
        {field, "Exact solution/Pressure=1 +"},
        {"Exact solution/Pressure (--set"});
}
