// Proves that with hanging nodes on the slave's side, on the master's or on
// both, within the bodies and where displacements are prescribed, with one
// degree and with several in each body, the solution without a matrix is that
// of the factorised one, and that multigrid needs hardly more iterations for
// it, on every number of ranks.
#include <scenes/scene.h>

#include "scenes/scenes.h"

using namespace mortise;
using namespace mortise::testing;

namespace
{
  Settings
  degree(const unsigned int p, const std::string &a, const std::string &b)
  {
    return {"Body " + a + "/Degree=" + std::to_string(p),
            "Body " + b + "/Degree=" + std::to_string(p)};
  }

  void
  check_iterations(const std::string &name,
                   const std::string &text,
                   const Settings    &settings,
                   const unsigned int iterations)
  {
    const StepSummary step =
      run_scene(text,
                settings +
                  Settings{"Solver/Method=condensed", "Solver/Tolerance=1e-8"})
        .steps.back();
    verdict(name + ": " + std::to_string(iterations) + " iterations",
            *step.solver->iterations,
            iterations);
    verdict(name + ": residual", step.solver->relative_residual, 1e-8);
  }

  void
  check_solution(const std::string &name,
                 const std::string &text,
                 const Settings    &settings)
  {
    const StepSummary expected =
      run_scene(text,
                settings +
                  Settings{"Solver/Method=direct", "Solver/Tolerance=1e-12"})
        .steps.back();
    for (const std::string method : {"condensed", "saddle point"})
      {
        const StepSummary step =
          run_scene(text,
                    settings + Settings{"Solver/Method=" + method,
                                        "Solver/Tolerance=1e-12"})
            .steps.back();
        const auto compare = [&](const std::string           &what,
                                 const std::optional<double> &got,
                                 const std::optional<double> &allowed) {
          verdict(name + ", " + method + ": " + what,
                  std::fabs(*got / *allowed - 1.),
                  1e-9);
        };
        compare("energy error", step.errors->energy, expected.errors->energy);
        compare("L2 error",
                step.errors->displacement_l2,
                expected.errors->displacement_l2);
        compare("error of the traction",
                step.errors->multiplier_l2,
                expected.errors->multiplier_l2);
        double difference = 0.;
        for (unsigned int q = 0; q < expected.quantities.size(); ++q)
          for (unsigned int c = 0; c < dim; ++c)
            difference = std::max(difference,
                                  std::fabs(step.quantities[q].second[c] -
                                            expected.quantities[q].second[c]));
        verdict(name + ", " + method + ": displacements", difference, 1e-11);
      }
  }

  struct LocalRefinement
  {
    std::string name, lower, upper;
  };
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string                        sphere = two_layers(true);
  const Settings                           coarse = {
    "Body inner/Mesh/Subdivisions=2, 1",
    "Body outer/Mesh/Subdivisions=3, 1",
    "Output/Points=i: inner: 0, 0, 1; o: outer: 2, 0, 0"};
  for (const auto &[name, inner, outer] :
       {LocalRefinement{"slave", "0, 0, 1.5, 0.6, 1", ""},
        LocalRefinement{"master", "", "1.5, 0, 0, 0.5, 1"},
        LocalRefinement{"both", "0, 0, 1.5, 0.6, 1", "0, 0, 1.5, 0.3, 2"}})
    {
      const Settings meshes =
        coarse + Settings{"Body inner/Mesh/Refine near=" + inner,
                          "Body outer/Mesh/Refine near=" + outer};
      for (const unsigned int p : {2, 3})
        check_solution("sphere, " + name + ", p = " + std::to_string(p),
                       sphere,
                       meshes + degree(p, "inner", "outer"));
      for (const unsigned int p : {2, 3, 4, 5, 6})
        check_iterations("sphere, " + name + ", p = " + std::to_string(p),
                         sphere,
                         meshes + degree(p, "inner", "outer"),
                         18);
      for (const std::string regions : {"0: 2; 1: 4; 2: 3", "0: 5; 1: 2; 2: 1"})
        {
          const std::string mixed =
            "sphere, " + name + ", p by region " + regions;
          const Settings degrees = {"Body inner/Degree by region=" + regions,
                                    "Body outer/Degree by region=" + regions};
          check_solution(mixed, sphere, meshes + degrees);
          check_iterations(mixed, sphere, meshes + degrees, 20);
        }
    }
  for (const auto &[name, lower, upper] :
       {LocalRefinement{"slave", "0, 0, 0.5, 0.3, 2", ""},
        LocalRefinement{"master", "", "1, 0, 0.5, 0.3, 2"}})
    check_solution("clamped rim, " + name,
                   manufactured(),
                   degree(3, "lower", "upper") +
                     Settings{"Body lower/Mesh/Subdivisions=2, 2, 1",
                              "Body upper/Mesh/Subdivisions=3, 3, 1",
                              "Body lower/Mesh/Refine near=" + lower,
                              "Body upper/Mesh/Refine near=" + upper,
                              "Output/Points=i: lower: 0.5, 0.5, 0.3"});
}
