// Proves that multipliers go on where a slave ends at a kink and its edges hang
// on the edge of a larger cell that has no face there: around the re-entrant
// edge of an L cubic displacements pass ties exactly, pressure from all sides
// what slides or touches.
#include <filesystem>

#include "scene.h"
#include "scenes.h"

using namespace mortise;
using namespace mortise::testing;

namespace
{
  std::string
  interface(const std::string &name,
            const std::string &slave,
            const std::string &master,
            const std::string &law)
  {
    return "subsection Interface " + name + "\n  set Slave = " + slave +
           "\n  set Master = " + master + "\n  set Law = " + law + "\nend\n";
  }

  /// A cube in the L on the slab; the L and the cube have the faces of one
  /// block.
  std::string
  scene(const std::string &law)
  {
    return "set Bodies = slab, corner, cube\n"
           "set Interfaces = corner on slab, cube on slab, cube in corner x, "
           "cube in corner y\n"
           "subsection Output\n  set Directory = unused\n  set Fields =\nend\n" +
           box("slab", "-1, -1, -1, 1, 1, 0", "xmin xmax ymin ymax zmin", "") +
           body("corner", "file", "", "xmin xmax ymin ymax zmax", "") +
           box("cube", "0, 0, 0, 1, 1, 1", "xmax ymax zmax", "") +
           interface("corner on slab", "corner: zmin", "slab: zmax", law) +
           interface("cube on slab", "slab: zmax", "cube: zmin", law) +
           interface("cube in corner x", "corner: inner x", "cube: xmin", law) +
           interface("cube in corner y", "corner: inner y", "cube: ymin", law);
  }

  void
  check(const std::string &law,
        const unsigned int degree,
        const std::string &near,
        const std::string &displacement)
  {
    Settings settings = {"Exact solution/Displacement=" + displacement,
                         "Body slab/Mesh/Subdivisions=6, 6, 2",
                         "Body cube/Mesh/Subdivisions=4, 4, 4",
                         "Body corner/Mesh/File=" +
                           (std::filesystem::path(__FILE__).parent_path() /
                            "../../meshes/l_shape_sides.msh")
                             .string(),
                         "Body corner/Mesh/Refine near=" + near,
                         "Solver/Tolerance=1e-13"};
    for (const std::string name : {"slab", "corner", "cube"})
      settings.push_back("Body " + name + "/Degree=" + std::to_string(degree));
    const Summary     summary = run_scene(scene(law), settings);
    const std::string what =
      law + ", degree " + std::to_string(degree) + ", halved near " + near;
    exact_verdicts(what, *summary.steps.back().errors);
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string cubic   = "0.01*x^3 + 0.02*x*y*z - 0.03*y*z^2; "
                              "0.005*x*y^2 - 0.01*x*z^2 + 0.02*z^3; "
                              "0.03*x*z^2 + 0.01*x*y*z - 0.02*y^3",
                    pressed = "-0.01*x; -0.01*y; -0.01*z";
  for (const unsigned int p : {3, 4})
    for (const std::string near :
         {"0.5, -0.5, 0.5, 0.2, 2", "-0.5, 0.5, 0.5, 0.2, 2"})
      check("tie", p, near, cubic);
  for (const std::string law : {"slide", "contact"})
    for (const unsigned int p : {2, 3})
      check(law, p, "0.5, -0.5, 0.5, 0.2, 1", pressed);
}
