// Proves that two tied layers of flat cells and a film on a block take 15
// iterations at most (the film on tetrahedra of degree 3 25) and are exact,
// hexahedra and tetrahedra, meshes that match or do not. The same on every
// number of ranks.
#include "linear_field.h"
#include "scene.h"
#include "scenes.h"

using namespace mortise;
using namespace mortise::testing;

namespace
{
  const LinearField field = {
    {{0.1, 0.03, -0.01}, {0.01, 0.05, 0.04}, {0.02, 0.06, -0.07}}};

  /// From z = 0 to @p lower and on to @p lower + @p upper.
  Settings
  heights(const double lower, const double upper)
  {
    std::ostringstream first, second;
    first << "0, 0, 0, 1, 1, " << lower;
    second << "0, 0, " << lower << ", 1, 1, " << lower + upper;
    return {"Body lower/Mesh/Extent=" + first.str(),
            "Body upper/Mesh/Extent=" + second.str()};
  }

  Settings
  meshes(const std::string &lower,
         const std::string &upper,
         const unsigned int degree)
  {
    return {"Body lower/Mesh/Subdivisions=" + lower,
            "Body upper/Mesh/Subdivisions=" + upper,
            "Body lower/Degree=" + std::to_string(degree),
            "Body upper/Degree=" + std::to_string(degree)};
  }

  void
  check(const std::string &what,
        const Settings    &settings,
        const unsigned int n_iterations)
  {
    const StepSummary step =
      run_scene(two_boxes(),
                field.displacement() + settings +
                  Settings{"Solver/Method=condensed", "Solver/Tolerance=1e-8"})
        .steps.back();
    verdict(what + ": iterations", *step.solver->iterations, n_iterations);
    verdict(what + ": displacement", *step.errors->displacement_l2, 1e-8);
    verdict(what + ": stress", *step.errors->energy, 1e-6);
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const Settings tetrahedra = {"Body lower/Mesh/Cells=tetrahedra",
                               "Body upper/Mesh/Cells=tetrahedra"};
  for (const double h : {1e-2, 1e-3})
    for (const unsigned int p : {1, 2, 3})
      {
        const std::string name =
          "height " + std::to_string(h) + ", degree " + std::to_string(p);
        check("matching, " + name,
              heights(h, h) + meshes("4, 4, 3", "4, 4, 3", p),
              15);
        check("3 on 4, " + name,
              heights(h, h) + meshes("3, 3, 3", "4, 4, 2", p),
              15);
        check("tetrahedra, " + name,
              heights(h, h) + meshes("4, 4, 3", "3, 3, 2", p) + tetrahedra,
              15);
      }
  const Settings film_is_slave = {"Interface glue/Slave=upper: zmin",
                                  "Interface glue/Master=lower: zmax"};
  for (const unsigned int p : {2, 3})
    {
      const std::string name = "a film, degree " + std::to_string(p);
      const Settings film = heights(1., 1e-3) + meshes("3, 3, 3", "4, 4, 2", p);
      check(name, film, 15);
      check(name + ", the film is the slave", film + film_is_slave, 15);
      check(name + ", tetrahedra", film + tetrahedra, p == 2 ? 15 : 25);
    }
}
