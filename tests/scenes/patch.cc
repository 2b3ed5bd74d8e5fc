// Proves that linear displacements pass non-matching interfaces exactly: any
// degree, mesh ratio, strain, rotation, side of the slave, hanging nodes and
// mixed degrees on either side.
#include "scene.h"
#include "scenes.h"

using namespace mortise;
using namespace mortise::testing;

namespace
{
  const std::string general =
    "Exact solution/Displacement=0.1*x + 0.03*y - 0.02*z; "
    "0.05*y + 0.04*z + 0.01*x; -0.07*z + 0.02*x + 0.06*y";

  void
  check(const std::string &what,
        const std::string &text,
        const Settings    &settings)
  {
    const Summary      summary = run_scene(text,
                                      Settings{general} + settings +
                                        Settings{"Solver/Tolerance=1e-13"});
    const StepSummary &step    = summary.steps.back();
    exact_verdicts(what, *step.errors);
    for (const InterfaceSummary &interface : step.interfaces)
      {
        verdict(what + ": coverage 1e-12",
                *interface.worst_face_coverage_error,
                1e-12);
        verdict(what + ": partition of unity 1e-13",
                *interface.partition_of_unity_error,
                1e-13);
        verdict(what + ": force 1e-12", *interface.force_residual, 1e-12);
        verdict(what + ": moment 1e-12", *interface.moment_residual, 1e-12);
      }
  }

} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string                        text = two_boxes();
  const Settings swapped = {"Interface glue/Slave=upper: zmin",
                            "Interface glue/Master=lower: zmax"};
  const Settings direct  = {"Solver/Method=direct"};

  for (const unsigned int p : {1, 2, 3})
    check("3:4, degree " + std::to_string(p),
          text,
          meshes("3, 3, 1", "4, 4, 1", p) + direct);
  for (const unsigned int p : {4, 5, 6, 7, 8})
    check("1:2, degree " + std::to_string(p),
          text,
          meshes("1, 1, 1", "2, 1, 1", p) + direct);
  for (const unsigned int p : {4, 5, 6, 7, 8})
    {
      const std::string degree = ", degree " + std::to_string(p);
      check("3:4" + degree, text, meshes("3, 1, 1", "4, 1, 1", p));
      check("7:11" + degree, text, meshes("7, 1, 1", "11, 1, 1", p));
      check("1:20" + degree, text, meshes("1, 1, 1", "20, 1, 1", p));
    }
  check("7:11", text, meshes("7, 7, 1", "11, 11, 1", 1) + direct);
  check("1:20, fine slave",
        text,
        meshes("1, 1, 1", "20, 20, 1", 1) + direct + swapped);
  check("1:20, every vertex of the slave prescribed",
        text,
        meshes("1, 1, 1", "20, 20, 1", 1) + direct);
  check("1:20, the same by conjugate gradients",
        text,
        meshes("1, 1, 1", "20, 20, 1", 1) +
          Settings{"Solver/Method=condensed"});
  check("1 x 5 against 4 x 7, every vertex of the slave prescribed",
        text,
        meshes("1, 5, 1", "4, 7, 1", 1) + direct);
  check("20:1, degree 2",
        text,
        meshes("20, 2, 1", "1, 1, 1", 2) + direct + swapped);
  check("slave and master exchanged",
        text,
        meshes("3, 3, 1", "4, 4, 1", 2) + direct + swapped);

  const std::string axes[] = {"x", "y", "z"};
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = i; j < 3; ++j)
      {
        std::string u[3] = {"0", "0", "0"};
        u[i]             = "0.1*" + axes[j];
        if (i != j)
          u[j] = "0.1*" + axes[i];
        check("strain " + axes[i] + axes[j],
              text,
              meshes("2, 2, 1", "3, 3, 1", 1) + direct +
                Settings{"Exact solution/Displacement=" + u[0] + ";" + u[1] +
                         ";" + u[2]});
      }
  const Settings turned = {"Body lower/Mesh/Rotate=20, 30, 50",
                           "Body upper/Mesh/Rotate=20, 30, 50"};
  check("rotated", text, meshes("3, 3, 1", "4, 4, 1", 2) + direct + turned);
  check("tilted interface",
        text,
        meshes("3, 3, 1", "4, 4, 1", 2) + direct +
          Settings{"Body lower/Mesh/Top slope=0.3, -0.2",
                   "Body upper/Mesh/Bottom slope=0.3, -0.2"});
  check("hanging nodes on both sides",
        text,
        meshes("2, 2, 1", "3, 3, 1", 2) + direct +
          Settings{"Body lower/Mesh/Refine near=0.2, 0.2, 0.5, 0.4, 1",
                   "Body upper/Mesh/Refine near=0.9, 0.3, 0.5, 0.3, 1"});
  for (const unsigned int p : {2, 4})
    for (const std::string method : {"condensed", "saddle point"})
      check("hanging nodes on both sides, degree " + std::to_string(p) + ", " +
              method,
            text,
            meshes("2, 2, 1", "3, 3, 1", p) +
              Settings{"Solver/Method=" + method,
                       "Body lower/Mesh/Refine near=0.2, 0.2, 0.5, 0.4, 1",
                       "Body upper/Mesh/Refine near=0.9, 0.3, 0.5, 0.3, 2"});
  check("mixed degrees and hanging nodes on both sides",
        text,
        meshes("2, 2, 2", "2, 2, 2", 1) + direct +
          Settings{"Body lower/Degree by region=4: 3; 5: 2",
                   "Body upper/Degree by region=0: 2; 3: 4",
                   "Body lower/Mesh/Refine near=0.2, 0.2, 0.5, 0.3, 1",
                   "Body upper/Mesh/Refine near=0.9, 0.3, 0.5, 0.3, 1"});
}
