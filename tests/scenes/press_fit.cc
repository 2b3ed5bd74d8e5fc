// Proves press fits of cylinders and spheres, whose meshes coincide: errors
// fall at the rates of the degree with bodies that slide, as they do with
// bodies that are tied, in all pairings of cells, the slave on either side, and
// the same on any number of ranks.
#include "scene.h"
#include "scenes.h"

using namespace mortise;
using namespace mortise::testing;

namespace
{
  std::string
  fit(const bool sphere, const std::string &law)
  {
    return tied("inner, outer", "inner: outside", "outer: inside") +
           layer("inner", "1, 1.5", sphere, false) +
           layer("outer", "1.5, 2", sphere, false) +
           "subsection Body outer\n  subsection Material\n"
           "    set Young modulus = 4\n    set Poisson ratio = 0.2\n  end\nend\n"
           "subsection Interface glue\n  set Offset = -0.01\n  set Law = " +
           law + "\nend\n" +
           "subsection Exact solution\n  set Displacement = thick " +
           (sphere ? "sphere" : "cylinder") + "\nend\n" +
           "subsection Solver\n  set Tolerance = 1e-13\nend\n";
  }

  Settings
  meshes(const bool sphere, const unsigned int n, const unsigned int p)
  {
    const auto mesh = [&](const std::string &body, const unsigned int around) {
      const std::string layers = std::to_string(std::max(1u, n / 2));
      return Settings{"Body " + body + "/Mesh/Subdivisions=" +
                        std::to_string(sphere ? around : 2 * around) + ", " +
                        layers + (sphere ? "" : ", " + layers),
                      "Body " + body + "/Degree=" + std::to_string(p)};
    };
    return mesh("inner", n) + mesh("outer", 3 * n / 2);
  }

  ErrorSummary
  errors(const std::string &text,
         const Settings    &settings,
         const MPI_Comm     comm = MPI_COMM_WORLD)
  {
    return *run_scene(text, settings, comm).steps.back().errors;
  }

  void
  check_rates()
  {
    for (const bool sphere : {false, true})
      for (const std::string law : {"slide", "tie"})
        for (unsigned int p = 1; p <= (law == "tie" ? 3 : 6); ++p)
          {
            const unsigned int n = p < 5 ? 4 : 2; // few cells at high degrees
            // where bodies are tied the offset goes along normals of the mesh,
            // which are good to p in odd degrees
            const RateSlack slack = law == "tie" ? RateSlack{0.55, 1.} :
                                    p < 5        ? RateSlack{0.25, 0.5} :
                                                   RateSlack{0.65, 0.5};
            rate_verdicts((sphere ? "spheres, " : "cylinders, ") + law +
                            ", degree " + std::to_string(p),
                          p,
                          errors(fit(sphere, law), meshes(sphere, n, p)),
                          errors(fit(sphere, law), meshes(sphere, 2 * n, p)),
                          slack);
          }
  }

  void
  check_pairings()
  {
    for (const std::string inner : {"hexahedra", "tetrahedra"})
      for (const std::string outer : {"hexahedra", "tetrahedra"})
        for (const bool exchanged : {false, true})
          for (const unsigned int p : {1, 2, 3})
            {
              if (inner == "hexahedra" && outer == inner && !exchanged)
                continue;
              Settings settings{"Body inner/Mesh/Cells=" + inner,
                                "Body outer/Mesh/Cells=" + outer};
              if (exchanged)
                settings =
                  settings + Settings{"Interface glue/Slave=outer: inside",
                                      "Interface glue/Master=inner: outside"};
              const std::string text = fit(true, "slide");
              rate_verdicts("spheres, " + inner + " in " + outer +
                              (exchanged ? ", slave outside" : "") +
                              ", degree " + std::to_string(p),
                            p,
                            errors(text, settings + meshes(true, 2, p)),
                            errors(text, settings + meshes(true, 4, p)),
                            {0.4, 0.6});
            }
  }

  void
  check_ranks()
  {
    for (const std::string method : {"condensed", "saddle point", "direct"})
      {
        const Settings settings =
          meshes(false, 4, 2) + Settings{"Solver/Method=" + method};
        const ErrorSummary one = errors(fit(false, "slide"),
                                        settings,
                                        MPI_COMM_SELF),
                           all = errors(fit(false, "slide"), settings);
        verdict(method + ": the same energy error on one rank 1e-6",
                std::fabs(*all.energy / *one.energy - 1.),
                1e-6);
        verdict(method + ": the same traction error on one rank 1e-6",
                std::fabs(*all.multiplier_l2 / *one.multiplier_l2 - 1.),
                1e-6);
      }
  }
} // namespace

int
main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1)
    {
      check_rates();
      check_pairings();
    }
  check_ranks();
}
