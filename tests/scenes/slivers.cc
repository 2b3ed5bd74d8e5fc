// Proves that slivers cost no accuracy: edges that coincide or nearly do, and
// faces of sizes 1 : 50, pass linear displacements to 1e-10 with either side as
// the slave.
#include <mortise/base/run_log.h>

#include "linear_field.h"
#include "scene.h"
#include "scenes.h"

using namespace mortise;
using namespace mortise::testing;

namespace
{
  const LinearField field = {
    {{0.1, 0.03, -0.01}, {0.01, 0.05, 0.04}, {0.02, 0.06, -0.07}}};
  const Settings swapped = {"Interface glue/Slave=upper: zmin",
                            "Interface glue/Master=lower: zmax"};

  void
  check(const std::string &what, const Settings &settings)
  {
    std::vector<std::string> warnings;
    const StepSummary        step =
      run_scene(two_boxes(),
                field.displacement() + settings +
                  Settings{"Solver/Method=direct", "Solver/Tolerance=1e-13"},
                MPI_COMM_WORLD,
                &warnings)
        .steps.back();
    exact_verdicts(what, *step.errors);
    const InterfaceSummary &interface = step.interfaces[0];
    verdict(what + ": coverage 1e-12",
            *interface.worst_face_coverage_error,
            1e-12);
    verdict(what + ": partition of unity 1e-13",
            *interface.partition_of_unity_error,
            1e-13);
    verdict(what + ": no warning", warnings.size(), 0);
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const unsigned int p : {1, 2})
    {
      const std::string degree = ", degree " + std::to_string(p);
      // the coarse slave has free vertices inside, so that it carries
      // multipliers
      check("1:50, coarse slave" + degree, meshes("2, 2, 1", "100, 3, 1", p));
      check("1:50, fine slave" + degree,
            meshes("2, 2, 1", "100, 3, 1", p) + swapped);
      check("1:1, edges coincide" + degree, meshes("3, 3, 1", "3, 3, 1", p));
      check("1:2, edges coincide" + degree, meshes("2, 2, 1", "4, 4, 1", p));
      check("2:1, edges coincide" + degree,
            meshes("2, 2, 1", "4, 4, 1", p) + swapped);
      // the master reaches beyond the slave by this length, where it bears a
      // load; its edges across x pass those of the slave at three quarters, a
      // half and a quarter of it
      for (const double shift : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-15})
        {
          const std::string what = "edges " + RunLog::number(shift) +
                                   " apart, slave ",
                            extent = "Mesh/Extent=" + number(-shift) + ", 0, ",
                            load =
                              step(0., -shift, -shift + (1. + shift) / 4., p);
          check(what + "below" + degree,
                meshes("4, 3, 1", "4, 4, 1", p) +
                  Settings{"Body upper/" + extent + "0.5, 1, 1, 1"} +
                  field.loads("0", load));
          check(what + "above" + degree,
                meshes("4, 3, 1", "4, 4, 1", p) + swapped +
                  Settings{"Body lower/" + extent + "0, 1, 1, 0.5"} +
                  field.loads(load, "0"));
        }
      // vertices that are moved at random by this fraction of a face: edges
      // pass or cross each other
      for (const std::string shift :
           {"1e-2", "1e-4", "1e-6", "1e-8", "1e-10", "1e-12", "1e-15"})
        {
          const Settings moved = meshes("4, 4, 1", "4, 4, 1", p) +
                                 Settings{"Body upper/Mesh/Distort=" + shift};
          check("vertices " + shift + " apart, regular slave" + degree, moved);
          check("vertices " + shift + " apart, moved slave" + degree,
                moved + swapped);
        }
    }
}
