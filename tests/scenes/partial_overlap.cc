// Proves that where only a part of the slave meets the master, that part is
// tied: the covered area is exact, one warning names the worst face, and
// constant stresses are exact for degrees 1 to 3.
//
// Multipliers of degree 1 stay on faces that are covered in part, so constant
// tractions pass. If the parts off the overlap bear the exact traction as a
// load, a linear displacement is the discrete solution. That load jumps at the
// rim of the overlap. Where the rim cuts faces along one of their directions,
// the load is given as its L2 projection to the degree of the elements, which
// has the same moments and is integrated exactly; where it cuts corners, the
// stress is one without traction on the interface. The upper body has no
// prescribed displacement: the tied part alone holds it.
#include "linear_field.h"
#include "scene.h"
#include "scenes.h"

using namespace mortise;
using namespace mortise::testing;

namespace
{
  const LinearField all_stresses = {
    {{0.1, 0.03, -0.01}, {0.01, 0.05, 0.04}, {0.02, 0.06, -0.07}}};
  const LinearField plane_stresses = {
    {{0.1, 0.03, -0.02}, {0.01, 0.05, 0.04}, {0.02, -0.04, -0.05}}};
  const Settings swapped = {"Interface glue/Slave=upper: zmin",
                            "Interface glue/Master=lower: zmax"};

  /// The lower body is the unit square below z = 0.5.
  std::string
  scene(const std::string &upper)
  {
    return tied("lower, upper", "lower: zmax", "upper: zmin") +
           box("lower", "0, 0, 0, 1, 1, 0.5", "zmin", "xmin xmax ymin ymax") +
           box("upper", upper, "", "xmin xmax ymin ymax zmax");
  }

  /// @p warning: the end of the one warning; empty: no warning.
  void
  check(const std::string &what,
        const std::string &text,
        const Settings    &settings,
        const double       coverage,
        const std::string &warning)
  {
    std::vector<std::string> warnings;
    const StepSummary        step =
      run_scene(text,
                settings + Settings{"Solver/Tolerance=1e-13"},
                MPI_COMM_WORLD,
                &warnings)
        .steps.back();
    exact_verdicts(what, *step.errors);
    const InterfaceSummary &interface = step.interfaces[0];
    verdict(what + ": covered fraction 1e-12",
            std::fabs(interface.covered_area / interface.slave_area - coverage),
            1e-12);
    verdict(what + ": partition of unity 1e-12",
            *interface.partition_of_unity_error,
            1e-12);
    verdict(what + ": force 1e-12", *interface.force_residual, 1e-12);
    verdict(what + ": moment 1e-12", *interface.moment_residual, 1e-12);
    const bool right =
      warning.empty() ? warnings.empty() :
                        warnings.size() == 1 &&
                          warnings[0].find("worst is the face at " + warning) !=
                            std::string::npos;
    verdict(what +
              (warning.empty() ? ": no warning" : ": one warning, " + warning),
            right ? 0 : 1,
            0);
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string inside = scene("0.25, 0.25, 0.5, 0.75, 0.75, 1"),
                    out    = scene("0.45, 0, 0.5, 1.45, 1, 1"),
                    across = scene("0.3, 0.2, 0.5, 0.8, 1.3, 1");
  const std::string off_inside =
    "if(abs(x - 0.5) < 0.25 && abs(y - 0.5) < 0.25, 0, 1)";
  const std::string corner = "0.166667 0.166667 0.5 (96 % off)";

  for (const unsigned int p : {1, 2, 3})
    {
      const std::string degree = ", degree " + std::to_string(p);
      const Settings    inside_loads =
        all_stresses.displacement() + all_stresses.loads(off_inside, "0");
      const Settings out_loads =
        all_stresses.displacement() +
        all_stresses.loads(step(0.45, 0.4, 0.6, p),
                           "1 - " + step(1., 0.95, 1.2, p));
      check("small master" + degree,
            inside,
            meshes("4, 4, 1", "3, 3, 1", p) + inside_loads,
            0.25,
            "0.125 0.125 0.5 (100 % off)");
      check("small slave" + degree,
            inside,
            meshes("4, 4, 1", "3, 3, 1", p) + inside_loads + swapped,
            1.,
            "");
      check("half out" + degree,
            out,
            meshes("5, 3, 1", "4, 2, 1", p) + out_loads,
            0.55,
            "0.1 0.166667 0.5 (100 % off)");
      check("half out, swapped" + degree,
            out,
            meshes("5, 3, 1", "4, 2, 1", p) + out_loads + swapped,
            0.55,
            "1.325 0.25 0.5 (100 % off)");
      check("cut faces" + degree,
            across,
            meshes("3, 3, 1", "4, 4, 1", p) + plane_stresses.displacement(),
            0.4,
            corner);
      check("cut faces, swapped" + degree,
            across,
            meshes("3, 3, 1", "1, 2, 1", p) + plane_stresses.displacement() +
              swapped,
            8. / 11.,
            "0.55 1.025 0.5 (54.55 % off)");
    }
  for (const std::string method : {"condensed", "saddle point"})
    check("cut faces, " + method,
          across,
          meshes("3, 3, 1", "4, 4, 1", 2) + plane_stresses.displacement() +
            Settings{"Solver/Method=" + method},
          0.4,
          corner);
}
