// Proves Law = spring: blocks with a spring between them are in series, along
// the normal and across it; press fits have the exact pressure at the rates of
// the degree; iterations are those of a tie over twelve orders of the
// stiffness, which tends to a tie and to what slides.
#include "scene.h"
#include "scenes.h"

using namespace mortise;
using namespace mortise::testing;

namespace
{
  Settings
  springs(const double normal, const double tangential)
  {
    return {"Interface glue/Law=spring",
            "Interface glue/Normal stiffness=" + number(normal),
            "Interface glue/Tangential stiffness=" + number(tangential)};
  }

  Settings
  both(const std::string &a, const std::string &b, const std::string &setting)
  {
    return {"Body " + a + "/" + setting, "Body " + b + "/" + setting};
  }

  /// Two cubes of modulus 900 and Poisson ratio 0, u at the sides and ends.
  std::string
  cubes(const std::string &lower, const std::string &upper)
  {
    std::string text = tied("lower, upper", "lower: zmax", "upper: zmin");
    for (const std::string name : {"lower", "upper"})
      {
        const bool below = name == "lower";
        text += "subsection Body " + name +
                "\n  subsection Mesh\n    set Source = box\n    set Extent = " +
                (below ? "0, 0, -1, 1, 1, 0" : "0, 0, 0, 1, 1, 1") +
                "\n  end\n  subsection Material\n    set Young modulus = 900\n"
                "    set Poisson ratio = 0\n  end\n";
        for (const std::string side :
             {"xmin", "xmax", "ymin", "ymax", below ? "zmin" : "zmax"})
          text += "  subsection Boundary " + side +
                  "\n    set Displacement = " + (below ? lower : upper) +
                  "\n  end\n";
        text += "end\n";
      }
    return text +
           "subsection Solver\n  set Tolerance = 1e-12\nend\n"
           "subsection Output\n  set Points = below: lower: 0.4, 0.3, 0; "
           "above: upper: 0.4, 0.3, 0\nend\n";
  }

  /// A uniform stress s e_c on the interface; the spring opens by s / k.
  void
  check_series(const std::string &what, const Settings &settings)
  {
    const double k[] = {500., 500., 2000.}, s = 3.;
    for (const unsigned int c : {0, 2})
      {
        // shear modulus and Young's modulus
        const double strain = s / (c == 2 ? 900. : 450.), opening = s / k[c];
        const auto   field = [&](const double at_interface) {
          std::string text;
          for (unsigned int d = 0; d < 3; ++d)
            text += (d == 0 ? "" : ", ") +
                    (d == c ? number(strain) + "*z + " + number(at_interface) :
                                std::string("0"));
          return text;
        };
        const Summary summary = run_scene(cubes(field(0.), field(opening)),
                                          springs(k[2], k[0]) + settings);
        const auto   &q       = summary.steps.back().quantities;
        for (unsigned int i = 0; i < 2; ++i)
          {
            double error = 0.;
            for (unsigned int d = 0; d < 3; ++d)
              error = std::max(error,
                               std::fabs(q[i].second[d] -
                                         (d == c && i == 1 ? opening : 0.)));
            verdict(what + (c == 2 ? ", normal" : ", tangential") +
                      (i == 0 ? ", below" : ", above") + " 1e-9",
                    error / opening,
                    1e-9);
          }
      }
  }

  void
  check_all_series()
  {
    const auto degree = [](const unsigned int p) {
      return both("lower", "upper", "Degree=" + std::to_string(p));
    };
    const Settings meshes = {"Body lower/Mesh/Subdivisions=3, 2, 2",
                             "Body upper/Mesh/Subdivisions=2, 3, 1"};
    for (const std::string method : {"condensed", "saddle point", "direct"})
      for (const std::string multiplier : {"standard", "dual"})
        for (const unsigned int p : {1, 3})
          check_series(method + ", " + multiplier + ", degree " +
                         std::to_string(p),
                       degree(p) + meshes +
                         Settings{"Solver/Method=" + method,
                                  "Interface glue/Multiplier=" + multiplier});
    for (const std::string method : {"condensed", "direct"})
      check_series("mixed degrees of tetrahedra, " + method,
                   degree(2) + meshes +
                     both("lower", "upper", "Mesh/Cells=tetrahedra") +
                     Settings{"Body lower/Degree by region=4: 3; 5: 2",
                              "Solver/Method=" + method});
    check_series("rotated",
                 degree(2) + meshes +
                   both("lower", "upper", "Mesh/Distort=0.1"));
  }

  /// Press fit with a spring of @p normal stiffness.
  std::string
  fit(const bool sphere)
  {
    return tied("inner, outer", "inner: outside", "outer: inside") +
           layer("inner", "1, 1.5", sphere, false) +
           layer("outer", "1.5, 2", sphere, false) +
           "subsection Interface glue\n  set Offset = -0.01\nend\n" +
           "subsection Exact solution\n  set Displacement = thick " +
           (sphere ? "sphere" : "cylinder") + "\nend\n";
  }

  Settings
  layers(const unsigned int p,
         const std::string &inner,
         const std::string &outer)
  {
    return both("inner", "outer", "Degree=" + std::to_string(p)) +
           Settings{"Body inner/Mesh/Subdivisions=" + inner,
                    "Body outer/Mesh/Subdivisions=" + outer,
                    "Solver/Tolerance=1e-11"};
  }

  void
  check_rates()
  {
    for (const double k : {5., 200.})
      for (const std::string cells : {"hexahedra", "tetrahedra"})
        for (const unsigned int p : {1, 2, 3})
          {
            const Settings all =
              springs(k, k) + both("inner", "outer", "Mesh/Cells=" + cells);
            const auto errors = [&](const std::string &inner,
                                    const std::string &outer) {
              return *run_scene(fit(true), all + layers(p, inner, outer))
                        .steps.back()
                        .errors;
            };
            rate_verdicts("spheres of " + cells + ", stiffness " + number(k) +
                            ", degree " + std::to_string(p),
                          p,
                          errors("2, 1", "3, 1"),
                          errors("4, 2", "6, 2"),
                          {0.55, 1.});
          }
  }

  /// E / h is about 30.
  void
  check_range()
  {
    const auto iterations = [](const Settings &settings) {
      return static_cast<unsigned int>(
        *run_scene(fit(false), settings).steps.back().solver->iterations);
    };
    for (const unsigned int p : {1, 2, 4})
      {
        Settings all = layers(p, "8, 2, 2", "12, 2, 2");
        all.push_back("Solver/Tolerance=1e-8");
        const unsigned int tie =
          iterations(all + Settings{"Interface glue/Multiplier=standard"});
        unsigned int most = 0;
        for (double k = 3e-5; k < 1e8; k *= 100.)
          for (const double ratio : {0.01, 1., 100.})
            most = std::max(most, iterations(all + springs(k, ratio * k)));
        verdict("degree " + std::to_string(p) +
                  ": no more than two iterations more than for a tie",
                most,
                tie + 2.);
      }
  }

  void
  check_limits()
  {
    Settings all = layers(3, "8, 2, 2", "12, 2, 2");
    all.push_back("Solver/Tolerance=1e-12");
    const auto energy = [&](const Settings &settings) {
      return *run_scene(fit(false), all + settings).steps.back().errors->energy;
    };
    const double tie   = energy({"Interface glue/Law=tie"}),
                 slide = energy({"Interface glue/Law=slide"});
    verdict("a stiff spring is a tie 1e-5",
            std::fabs(energy(springs(1e9, 1e9)) / tie - 1.),
            1e-5);
    verdict("a spring stiff along the normal alone slides 1e-5",
            std::fabs(energy(springs(1e9, 0.)) / slide - 1.),
            1e-5);
    // at symmetry planes the multipliers of both differ
    verdict("almost alone, too, 1e-3",
            std::fabs(energy(springs(1e9, 1e-4)) / slide - 1.),
            1e-3);
  }
} // namespace

int
main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_all_series();
  if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
    return 0;
  check_rates();
  check_range();
  check_limits();
}
