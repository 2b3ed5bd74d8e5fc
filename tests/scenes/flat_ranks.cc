// Proves that two thin plates of few cells, one shifted beside the other, that
// slide or touch, give the same on any number of ranks: what multipliers at the
// rim of the covered part move is then often of another rank. Each rank solves
// the scene alone and compares with all ranks together.
#include <array>

#include "scene.h"
#include "scenes.h"

using namespace mortise;
using namespace mortise::testing;

namespace
{
  /// Two square plates of length 1, the upper one at x, y.
  struct Plates
  {
    std::string                name;
    double                     x, y;
    std::array<double, 2>      thickness;
    std::array<std::string, 2> cells, degree; ///< cells are halved once
  };

  std::string
  text_of(const Plates &plates, const std::string &law)
  {
    std::ostringstream text;
    text << "set Bodies = lower, upper\nset Interfaces = touch\n"
            "subsection Interface touch\n  set Law = "
         << law
         << "\n  set Slave = upper: zmin\n  set Master = lower: zmax\nend\n"
            "subsection Solver\n  set Tolerance = 1e-12\nend\n"
            "subsection Output\n  set Points = inside: upper: "
         << plates.x + 0.3 << ", " << plates.y + 0.2 << ", "
         << plates.thickness[0] + 0.01
         << "\n  set Resultants = held: lower: zmin\nend\n";
    for (unsigned int b = 0; b < 2; ++b)
      {
        const double x = b * plates.x, y = b * plates.y,
                     z = b * plates.thickness[0];
        text << "subsection Body " << (b == 0 ? "lower" : "upper")
             << "\n  set Degree = " << plates.degree[b]
             << "\n  subsection Mesh\n    set Source = box\n    set Extent = "
             << x << ", " << y << ", " << z << ", " << x + 1. << ", " << y + 1.
             << ", " << z + plates.thickness[b]
             << "\n    set Subdivisions = " << plates.cells[b]
             << "\n    set Refinements = 1\n  end\n"
                "  subsection Material\n    set Young modulus = 1000\n  end\n"
                "  subsection Boundary "
             << (b == 0 ? "zmin" : "zmax") << "\n    set Displacement = 0, 0, "
             << (b == 0 ? "0" : "-0.001*(1 + 0.3*x)") << "\n  end\nend\n";
      }
    return text.str();
  }

  void
  check(const std::string &what,
        const std::string &text,
        const Settings    &settings)
  {
    const StepSummary alone =
      run_scene(text, settings, MPI_COMM_SELF).steps.back();
    const StepSummary together = run_scene(text, settings).steps.back();
    const auto        same     = [&](const std::string         &quantity,
                          const std::vector<double> &a,
                          const std::vector<double> &b) {
      double difference = 0., size = 0.;
      for (unsigned int c = 0; c < 3; ++c)
        {
          difference = std::max(difference, std::fabs(a[c] - b[c]));
          size       = std::max(size, std::fabs(b[c]));
        }
      verdict(what + ": " + quantity, difference / size, 1e-9);
    };
    for (unsigned int i = 0; i < alone.quantities.size(); ++i)
      same(alone.quantities[i].first,
           together.quantities[i].second,
           alone.quantities[i].second);
    same("force of the interface",
         together.interfaces.front().force,
         alone.interfaces.front().force);
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::vector<Plates>                all = {{"one cell below three",
                                                   0.,
                                                   0.47,
                                                   {{0.03, 0.02}},
                                                   {{"1, 1, 1", "3, 1, 2"}},
                                                   {{"1", "2"}}},
                                                  {"two cells below three",
                                                   -0.46,
                                                   0.56,
                                                   {{0.02, 0.03}},
                                                   {{"1, 2, 1", "3, 1, 1"}},
                                                   {{"2", "3"}}},
                                                  {"a corner",
                                                   0.6,
                                                   0.8,
                                                   {{0.05, 0.03}},
                                                   {{"1, 1, 1", "2, 2, 1"}},
                                                   {{"1", "1"}}}};
  for (const std::string law : {"slide", "contact"})
    for (const std::string method : {"condensed", "saddle point"})
      for (const Plates &plates : all)
        check(law + ", " + method + ", " + plates.name,
              text_of(plates, law),
              {"Solver/Method=" + method});
}
