// Proves that a scene gives the same where a body has fewer cells than there
// are ranks: one tetrahedron tied to one hexahedron, or to a second
// tetrahedron. Each rank solves the scene alone and compares with all ranks
// together.
#include <temporary_file.h>

#include <fstream>

#include "scene.h"
#include "scenes.h"

using namespace mortise;
using namespace mortise::testing;

namespace
{
  /// One tetrahedron below z = 0 (or above); its faces are named.
  std::string
  write_tetrahedron(const bool below)
  {
    const std::string name = temporary_file(below ? "below.msh" : "above.msh");
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::ofstream(name)
        << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n4\n"
           "2 1 \"tied\"\n2 2 \"xmin\"\n2 3 \"ymin\"\n2 4 \"slope\"\n"
           "$EndPhysicalNames\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 "
        << (below ? -1 : 1)
        << "\n$EndNodes\n$Elements\n5\n1 2 2 1 1 1 2 3\n2 2 2 2 2 1 3 4\n"
           "3 2 2 3 3 1 2 4\n4 2 2 4 4 2 3 4\n5 4 2 1 1 1 2 3 4\n"
           "$EndElements\n";
    MPI_Barrier(MPI_COMM_WORLD);
    return name;
  }

  /// A tetrahedron on symmetry planes, the slope under the exact traction or
  /// held.
  std::string
  tetrahedron(const std::string &name, const bool below)
  {
    const std::string slope = below ? "Traction" : "Displacement";
    return "subsection Body " + name +
           "\n  subsection Mesh\n    set Source = file\n    set File = " +
           write_tetrahedron(below) +
           "\n  end\n  subsection Material\n    set Young modulus = 900\n  end\n"
           "  subsection Boundary xmin\n    set Displacement = exact, -, -\n"
           "    set Traction = exact\n  end\n"
           "  subsection Boundary ymin\n    set Displacement = -, exact, -\n"
           "    set Traction = exact\n  end\n"
           "  subsection Boundary slope\n    set " +
           slope + " = exact\n  end\nend\n";
  }

  const std::string solution =
    "subsection Exact solution\n"
    "  set Displacement = 0.1*x*y; -0.05*y^2; 0.1*z - 0.1*x*y + 0.03*x^2\nend\n";

  void
  check(const std::string &what,
        const std::string &text,
        const Settings    &settings)
  {
    const StepSummary alone =
      run_scene(text, settings, MPI_COMM_SELF).steps.back();
    const StepSummary together = run_scene(text, settings).steps.back();
    const auto        same =
      [&](const std::string &quantity, const double a, const double b) {
        verdict(what + ": " + quantity + " 1e-8",
                std::fabs(a - b) / std::max(std::fabs(b), 1e-300),
                1e-8);
      };
    same("dofs", together.dofs.total, alone.dofs.total);
    same("L2 error",
         *together.errors->displacement_l2,
         *alone.errors->displacement_l2);
    same("energy error", *together.errors->energy, *alone.errors->energy);
    for (unsigned int c = 0; c < 3; ++c)
      same("tip " + std::to_string(c),
           together.quantities[0].second[c],
           alone.quantities[0].second[c]);
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string tetrahedra = tied("low, high", "low: tied", "high: tied") +
                                 tetrahedron("low", true) +
                                 tetrahedron("high", false) + solution;
  const std::string hexahedron =
    tied("low, high", "low: tied", "high: zmin") + tetrahedron("low", true) +
    "subsection Body high\n  subsection Mesh\n    set Subdivisions = 1, 1, 1\n"
    "  end\nend\n" +
    box("high", "0, 0, 0, 1, 1, 1", "zmax", "xmin xmax ymin ymax") + solution;
  const Settings fine = {"Output/Points=tip: low: 0.1, 0.2, -0.3",
                         "Solver/Tolerance=1e-12"};
  for (const std::string method : {"direct", "auto"})
    for (const std::string degree : {"1", "3", "5"})
      {
        const Settings settings = fine + Settings{"Solver/Method=" + method,
                                                  "Body low/Degree=" + degree,
                                                  "Body high/Degree=" + degree};
        check("two tetrahedra, degree " + degree + ", " + method,
              tetrahedra,
              settings);
        check("on a hexahedron, degree " + degree + ", " + method,
              hexahedron,
              settings);
      }
  // Five ranks share six tetrahedra so that one has none of them.
  for (const std::string degree : {"1", "3"})
    check("six tetrahedra each, degree " + degree,
          two_boxes() + solution,
          {"Output/Points=tip: lower: 0.1, 0.2, 0.3",
           "Solver/Tolerance=1e-12",
           // not in the space, so that errors are more than round-off
           "Exact solution/Displacement=0.1*sin(x + y); 0.1*exp(y)*z; "
           "0.1*cos(x*z)",
           "Body lower/Degree=" + degree,
           "Body upper/Degree=" + degree,
           "Body lower/Mesh/Cells=tetrahedra",
           "Body upper/Mesh/Cells=tetrahedra",
           "Body lower/Mesh/Subdivisions=1, 1, 1",
           "Body upper/Mesh/Subdivisions=1, 1, 1"});
  for (const std::string method : {"direct", "auto"})
    check("incompressible, " + method,
          hexahedron,
          fine + Settings{"Solver/Method=" + method,
                          "Body low/Material/Poisson ratio=0.5",
                          "Body high/Material/Poisson ratio=0.5",
                          "Body low/Degree=3",
                          "Body high/Degree=2",
                          "Exact solution/Displacement=0.1*x*y; -0.05*y^2; "
                          "0.03*x^2",
                          "Exact solution/Pressure=x + 2*y"});
}
