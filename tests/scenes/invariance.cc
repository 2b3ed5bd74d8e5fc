// Proves that relative errors do not depend on the units of lengths and moduli,
// on the place of the scene, nor on the method that solves it; and that a body
// may hang on its interface alone.
#include "scene.h"
#include "scenes.h"

using namespace mortise;
using namespace mortise::testing;

namespace
{
  const Settings small = {"Body inner/Degree=2",
                          "Body outer/Degree=2",
                          "Body inner/Mesh/Subdivisions=2, 1",
                          "Body outer/Mesh/Subdivisions=3, 1",
                          "Solver/Tolerance=1e-12"};

  ErrorSummary
  errors(const Settings &settings)
  {
    Settings all = small;
    all.insert(all.end(), settings.begin(), settings.end());
    return *run_scene(two_layers(true), all).steps.back().errors;
  }

  void
  check(const std::string &what, const Settings &settings)
  {
    static const ErrorSummary reference = errors({});
    const ErrorSummary        got       = errors(settings);
    const auto                same =
      [&](const std::string &name, const double a, const double b) {
        verdict(what + ": " + name + " error 1e-6", std::fabs(a - b) / b, 1e-6);
      };
    same("L2", *got.displacement_l2, *reference.displacement_l2);
    same("energy", *got.energy, *reference.energy);
    same("multiplier", *got.multiplier_l2, *reference.multiplier_l2);
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const std::string method : {"direct", "condensed", "saddle point"})
    {
      const std::string solve = "Solver/Method=" + method;
      check(method, {solve});
      check(method + ", lengths 1e-3",
            {solve,
             "Body inner/Mesh/Extent=1e-3, 1.5e-3",
             "Body outer/Mesh/Extent=1.5e-3, 2e-3"});
      check(method + ", lengths 1e6",
            {solve,
             "Body inner/Mesh/Extent=1e6, 1.5e6",
             "Body outer/Mesh/Extent=1.5e6, 2e6"});
      check(method + ", moduli 1e9",
            {solve,
             "Body inner/Material/Young modulus=1e10",
             "Body outer/Material/Young modulus=1e10"});
      for (const std::string load : {"1e90", "1e-90"})
        check(method + ", loads " + load,
              {solve, "Body inner/Boundary inside/Pressure=" + load});
      for (const std::string sign : {"", "-"})
        check(method + ", lengths 1e" + sign + "14, moduli 1e" + sign + "19",
              {solve,
               "Body inner/Mesh/Extent=1e" + sign + "14, 1.5e" + sign + "14",
               "Body outer/Mesh/Extent=1.5e" + sign + "14, 2e" + sign + "14",
               "Body inner/Material/Young modulus=1e" + sign + "19",
               "Body outer/Material/Young modulus=1e" + sign + "19"});
    }
  const std::string far = "/Mesh/Translate=3000, -2000, 1000";
  check("moved by 1e3 diameters", {"Body inner" + far, "Body outer" + far});
}
