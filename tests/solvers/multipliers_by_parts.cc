// Proves that multipliers of which no rank knows all pass linear displacements
// exactly and take as many iterations as those that all ranks know, and that
// they are gathered where a stiff slave is finer than its master and parts do
// not suffice.
#include <scenes/scene.h>

#include "scenes/scenes.h"

using namespace mortise;
using namespace mortise::testing;

namespace
{
  const std::string by_parts = "Solver/Multipliers on all ranks=0";

  bool
  is_by_parts(const StepSummary &step)
  {
    return step.solver->preconditioner->find("by parts") != std::string::npos;
  }

  void
  check_patch(const std::string &degree)
  {
    const std::string what = "degree " + degree;
    const StepSummary step =
      run_scene(two_boxes(),
                {"Exact solution/Displacement=0.1*x + 0.03*y - 0.02*z; "
                 "0.05*y + 0.04*z + 0.01*x; -0.07*z + 0.02*x + 0.06*y",
                 "Body lower/Degree=" + degree,
                 "Body upper/Degree=" + degree,
                 "Body lower/Mesh/Subdivisions=5, 5, 2",
                 "Body upper/Mesh/Subdivisions=7, 7, 3",
                 "Solver/Tolerance=1e-12",
                 by_parts})
        .steps.back();
    exact_verdicts(what, *step.errors);
    verdict(what + ": by parts", is_by_parts(step) ? 0 : 1, 0);
  }

  void
  check_iterations(const std::string &method, const std::string &degree)
  {
    const std::string what     = method + ", degree " + degree;
    const Settings    settings = {"Body inner/Degree=" + degree,
                                  "Body outer/Degree=" + degree,
                                  "Body inner/Mesh/Subdivisions=4, 2",
                                  "Body outer/Mesh/Subdivisions=5, 3",
                                  "Solver/Method=" + method};
    const StepSummary
      gathered = run_scene(two_layers(true), settings).steps.back(),
      parts =
        run_scene(two_layers(true), settings + Settings{by_parts}).steps.back();
    verdict(what + ": by parts",
            is_by_parts(parts) && !is_by_parts(gathered) ? 0 : 1,
            0);
    verdict(what + ": one iteration more",
            static_cast<double>(*parts.solver->iterations) -
              static_cast<double>(*gathered.solver->iterations),
            1);
    verdict(what + ": same energy error 1e-6",
            std::fabs(*parts.errors->energy / *gathered.errors->energy - 1.),
            1e-6);
  }

  void
  check_stiff_slave()
  {
    const StepSummary step = run_scene(two_layers(true),
                                       {"Body inner/Degree=4",
                                        "Body outer/Degree=4",
                                        "Body inner/Mesh/Subdivisions=8, 1",
                                        "Body outer/Mesh/Subdivisions=3, 3",
                                        "Body inner/Material/Young modulus=1e7",
                                        by_parts})
                               .steps.back();
    verdict("stiff slave: gathered", is_by_parts(step) ? 1 : 0, 0);
    verdict("stiff slave: 20 iterations", *step.solver->iterations, 20);
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const std::string degree : {"2", "3", "5"})
    check_patch(degree);
  for (const std::string degree : {"2", "4"})
    for (const std::string method : {"condensed", "saddle point"})
      check_iterations(method, degree);
  check_stiff_slave();
}
