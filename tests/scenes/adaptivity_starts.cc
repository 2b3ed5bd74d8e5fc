// Proves that a run which ends with its target met has an error that is no
// larger: from a hundred starts that were drawn by lot (adaptivity_starts.txt,
// written by tests/benchmarks/adaptivity_starts.py), and from those whose
// changes said nothing of the next one: cells at corners and edges that are cut
// in the first cycle, one cell that misses the field.
#include <filesystem>
#include <fstream>
#include <iterator>

#include "scene.h"
#include "scenes.h"

using namespace mortise;
using namespace mortise::testing;

namespace
{
  const auto top = std::filesystem::path(__FILE__).parent_path() / "../..";

  /// Does @p what end with its target met, and with a smaller error? Without @p must_meet it may stop before.
  bool
  check(const std::string &what,
        const std::string &text,
        const Settings    &settings,
        const bool         must_meet)
  {
    const Summary      summary = run_scene(text, settings);
    const StepSummary &last    = summary.steps.back();
    const bool         met     = summary.status == "done";
    if (must_meet)
      verdict(what + ": target met", met ? 0. : 1., 0.);
    if (met)
      verdict(what + ": error by target",
              *last.errors->energy / last.adaptivity->target,
              1.);
    return met;
  }

  std::string
  text_of(const std::string &file)
  {
    std::ifstream in(top / file);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  Settings
  target(const double error)
  {
    return {"Adaptivity/Target error=" + number(error)};
  }

  void
  check_starts()
  {
    std::ifstream file(top / "tests/scenes/adaptivity_starts.txt");
    std::string   line;
    unsigned int  n = 0, n_met = 0;
    while (std::getline(file, line))
      {
        const std::string separator = " | ", mesh = "File=";
        Settings          settings;
        for (std::size_t begin = 0, end = 0; end != std::string::npos;
             begin = end + separator.size())
          {
            end = line.find(separator, begin);
            settings.push_back(line.substr(begin, end - begin));
            auto &setting = settings.back();
            if (const auto at = setting.find(mesh); at != std::string::npos)
              setting.insert(at + mesh.size(), top.string() + "/");
          }
        n_met += check("start " + std::to_string(n++), "", settings, false);
      }
    verdict("starts", std::fabs(n - 100.), 0.);
    verdict("starts whose target is not met", n - n_met, 10.);
  }

  void
  check_corners()
  {
    std::string    fichera   = text_of("prm/fichera.prm");
    const Settings of_corner = {"Body upper/Mesh/File=" +
                                (top / "meshes/l_shape.msh").string()};
    const Settings seven     = {"Body lower/Mesh/Subdivisions=2, 2, 1",
                                "Body lower/Mesh/Refine near=",
                                "Body upper/Mesh/Refine near=",
                                "Body upper/Mesh/Refinements=0",
                                "Body lower/Degree=5",
                                "Body upper/Degree=5"};
    check("seven cubes of degree five",
          fichera,
          of_corner + seven + target(1e-2),
          true);
    check("a corner with cells that are small before",
          fichera,
          of_corner + target(2.5e-3),
          true);
    check("a crack, degree four",
          text_of("prm/crack.prm"),
          target(8e-2) + Settings{"Body left/Degree=4", "Body right/Degree=4"},
          true);
  }

  std::string
  one_body(const std::string &prescribed)
  {
    return "set Bodies = b\n" +
           box("b",
               "0, 0, 0, 1, 1, 1",
               prescribed,
               prescribed == "xmin" ? "xmax ymin ymax zmin zmax" : "") +
           "subsection Body b\nset Degree = 1\nsubsection Mesh\n"
           "set Subdivisions = 1, 1, 1\nend\nend\n";
  }

  void
  check_hidden_fields()
  {
    const std::string all = "xmin xmax ymin ymax zmin zmax";
    check("one cell that misses a wave",
          one_body("xmin"),
          target(3e-2) +
            Settings{"Exact solution/Displacement=0.01*sin(3*x); 0; 0"},
          true);
    check("odd and even degrees differ",
          one_body(all),
          target(0.2) +
            Settings{"Exact solution/Displacement=0.01*sin(4*pi*x); 0; 0"},
          true);
    const std::string two = tied("lower, upper", "upper: zmin", "lower: zmax") +
                            box("lower",
                                "0, 0, 0, 1, 2, 0.33333333333333331",
                                "xmax ymin",
                                "xmin ymax zmin") +
                            box("upper",
                                "0, 0, 0.33333333333333331, 1, 2, 1",
                                all.substr(0, 19) + " zmax",
                                "");
    check("a bump between the points of cells",
          two,
          target(0.3) + Settings{"Body lower/Mesh/Subdivisions=1, 3, 3",
                                 "Body upper/Mesh/Subdivisions=1, 2, 2",
                                 "Exact solution/Displacement=0.01*x; "
                                 "0.01*exp(-((x-0.765778)^2+(y-0.858489)^2+"
                                 "(z-0.823148)^2)/0.04); 0"},
          true);
    check("degrees one and six side by side",
          two,
          target(0.02) +
            Settings{"Body lower/Degree=6",
                     "Body lower/Mesh/Subdivisions=1, 2, 1",
                     "Body upper/Degree=1",
                     "Body upper/Mesh/Subdivisions=1, 2, 1",
                     "Exact solution/Displacement=0.1*sin(x + 2*y)*cos(2*z); "
                     "0.1*cos(2*x)*sin(y + z); 0"},
          true);
  }

  /// Stresses that are linear are found again on faces between cells of other
  /// sizes, degrees and shapes, and on interfaces: nothing is missing.
  void
  check_exact_solutions()
  {
    const Settings field = {
      "Exact solution/Displacement=0.1*x^2 - 0.2*y*z; 0.3*x*y + 0.1*z^2; "
      "0.2*x*z - 0.1*y^2"};
    const auto estimate = [&](const std::string &what,
                              const std::string &text,
                              const Settings    &settings) {
      const auto steps = run_scene(text, field + target(1e-3) + settings).steps;
      verdict(what + ": estimate 1e-8",
              *steps.back().adaptivity->estimate,
              1e-8);
    };
    const std::string one = one_body("xmin");
    estimate("linear stress, hanging nodes",
             one,
             {"Body b/Mesh/Subdivisions=2, 2, 2",
              "Body b/Mesh/Distort=0.1",
              "Body b/Mesh/Refine near=1, 1, 1, 0.3, 2; 0, 0, 1, 0.2, 1",
              "Body b/Degree=2",
              "Body b/Degree near=1, 0, 0, 0.6, 4; 0, 0, 0, 0.3, 3"});
    estimate("linear stress, tetrahedra",
             one,
             {"Body b/Mesh/Subdivisions=2, 3, 2",
              "Body b/Mesh/Cells=tetrahedra",
              "Body b/Degree=2",
              "Body b/Degree near=1, 0, 0, 0.6, 4"});
    estimate("linear stress, cells of gmsh",
             "set Bodies = b\nsubsection Body b\nset Degree = 2\nsubsection "
             "Material\nset Young modulus = 900\nend\nsubsection "
             "Boundary sides\nset Traction = exact\nend\nsubsection Boundary "
             "inner sides\nset Traction = exact\nend\nsubsection Boundary "
             "zmin\nset Displacement = exact\nend\nsubsection Boundary "
             "zmax\nset Traction = exact\nend\nend\n",
             {"Body b/Mesh/Source=file",
              "Body b/Mesh/File=" + (top / "meshes/l_shape.msh").string(),
              "Body b/Mesh/Refine near=0, 0, 0, 1e-6, 2"});
    estimate("linear stress, a tie",
             two_boxes(),
             {"Body lower/Mesh/Subdivisions=2, 2, 2",
              "Body upper/Mesh/Subdivisions=3, 3, 1",
              "Body lower/Degree=3",
              "Body upper/Degree=3"});
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_exact_solutions();
  check_corners();
  check_hidden_fields();
  check_starts();
}
