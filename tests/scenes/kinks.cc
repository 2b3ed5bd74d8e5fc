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
  body(const std::string &name,
       const std::string &mesh,
       const std::string &prescribed)
  {
    std::string text = "subsection Body " + name + "\n  subsection Mesh\n" +
                       mesh +
                       "  end\n  subsection Material\n    set Young modulus = 1\n"
                       "    set Poisson ratio = 0.3\n  end\n";
    std::istringstream names(prescribed);
    for (std::string boundary; names >> boundary;)
      text += "  subsection Boundary " + boundary +
              "\n    set Displacement = exact\n  end\n";
    return text + "end\n";
  }

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
    const std::string file =
      (std::filesystem::path(__FILE__).parent_path() /
       "../../meshes/l_shape_sides.msh")
        .string();
    return "set Bodies = slab, corner, cube\n"
           "set Interfaces = corner on slab, cube on slab, cube in corner x, "
           "cube in corner y\n"
           "subsection Output\n  set Directory = unused\n  set Fields =\nend\n" +
           body("slab",
                "    set Extent = -1, -1, -1, 1, 1, 0\n"
                "    set Subdivisions = 6, 6, 2\n",
                "xmin xmax ymin ymax zmin") +
           body("corner",
                "    set Source = file\n    set File = " + file + "\n",
                "xmin xmax ymin ymax zmax") +
           body("cube",
                "    set Extent = 0, 0, 0, 1, 1, 1\n"
                "    set Subdivisions = 4, 4, 4\n",
                "xmax ymax zmax") +
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
                         "Body corner/Mesh/Refine near=" + near,
                         "Solver/Tolerance=1e-13"};
    for (const std::string name : {"slab", "corner", "cube"})
      settings.push_back("Body " + name +
                         "/Degree=" + std::to_string(degree));
    const Summary     summary = run_scene(scene(law), settings);
    const std::string what    = law + ", degree " + std::to_string(degree) +
                             ", halved near " + near;
    exact_verdicts(what, *summary.steps.back().errors);
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string cubic = "0.01*x^3 + 0.02*x*y*z - 0.03*y*z^2; "
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
