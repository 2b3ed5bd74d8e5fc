// Proves bodies in mixed form, nu = 0.5 included: linear and quadratic
// displacements with constant and linear pressures pass interfaces exactly,
// also where nothing lets a body expand, and between mixed and displacement
// form in both roles; curved interfaces with clamped rims show the rates of
// displacement, pressure and multiplier; the errors of the thick sphere do not
// depend on nu and are those of conforming meshes.
#include "scene.h"
#include "scenes.h"

using namespace mortise;
using namespace mortise::testing;

namespace
{
  struct Pairing
  {
    std::string slave, master;
  };

  const std::vector<Pairing> pairings = {{"hexahedra", "hexahedra"},
                                         {"tetrahedra", "hexahedra"},
                                         {"tetrahedra", "tetrahedra"}};

  Settings
  of_both(const std::vector<std::string> &bodies, const std::string &setting)
  {
    Settings result;
    for (const std::string &body : bodies)
      result.push_back("Body " + body + "/" + setting);
    return result;
  }

  const std::vector<std::string> boxes  = {"lower", "upper"},
                                 layers = {"inner", "outer"};

  const Settings incompressible = of_both(boxes, "Material/Poisson ratio=0.5");

  Settings
  cells(const Pairing &pairing, const unsigned int p)
  {
    return of_both(boxes, "Degree=" + std::to_string(p)) +
           Settings{"Body lower/Mesh/Cells=" + pairing.slave,
                    "Body upper/Mesh/Cells=" + pairing.master,
                    "Body lower/Mesh/Subdivisions=2, 2, 1",
                    "Body upper/Mesh/Subdivisions=3, 2, 1",
                    "Solver/Tolerance=1e-13"};
  }

  /// Scenes whose solution the spaces hold.
  void
  check_exact(const std::string &what, const Settings &settings)
  {
    const auto errors = *run_scene(two_boxes(), settings).steps.back().errors;
    exact_verdicts(what, errors);
    verdict(what + ": pressure 1e-10", *errors.pressure_l2, 1e-10);
  }

  const Settings linear = {
    "Exact solution/Displacement=0.1*x + 0.03*y - 0.02*z; "
    "-0.04*y + 0.04*z + 0.01*x; -0.06*z + 0.02*x + 0.06*y",
    "Exact solution/Pressure=30"};

  const Settings quadratic = {
    "Exact solution/Displacement=0.1*y*z + 0.1*x^2 - 0.2*x*z; "
    "0.2*x*z - 0.1*x*y; 0.1*x*y - 0.1*x*z + 0.1*z^2",
    "Exact solution/Pressure=20*(x - y + z - 0.5)"};

  void
  check_patches()
  {
    for (const Pairing &pairing : pairings)
      {
        const std::string name = pairing.slave + " on " + pairing.master;
        for (const unsigned int p : {2, 3})
          {
            const std::string degree = ", degree " + std::to_string(p);
            check_exact("linear, " + name + degree,
                        linear + incompressible + cells(pairing, p));
            // with degree 2 triangles beside a clamped rim carry constants only
            if (p == 2 && pairing.slave == "tetrahedra")
              continue;
            check_exact("quadratic, " + name + degree,
                        quadratic + incompressible + cells(pairing, p));
            check_exact(
              "quadratic, held all around, " + name + degree,
              quadratic + incompressible + cells(pairing, p) +
                Settings{"Body lower/Boundary xmax/Traction=",
                         "Body lower/Boundary xmax/Displacement=exact",
                         "Body upper/Boundary xmax/Traction=",
                         "Body upper/Boundary xmax/Displacement=exact",
                         "Body upper/Boundary zmax/Traction=",
                         "Body upper/Boundary zmax/Displacement=exact"});
          }
        for (const std::string &mixed : boxes)
          check_exact("only " + mixed + " in mixed form, nu = 0.25, " + name,
                      Settings{linear[0],
                               "Body " + mixed + "/Formulation=mixed"} +
                        cells(pairing, 2));
      }
    check_exact(
      "hanging nodes and mixed degrees",
      quadratic + incompressible + cells(pairings[0], 2) +
        Settings{"Body lower/Mesh/Subdivisions=2, 2, 2",
                 "Body lower/Degree by region=4: 3; 5: 4",
                 "Body lower/Mesh/Refine near=0.2, 0.2, 0.5, 0.3, 1"});
    check_exact("hanging nodes",
                quadratic + incompressible + cells(pairings[0], 3) +
                  Settings{
                    "Body lower/Mesh/Refine near=0.2, 0.2, 0.5, 0.3, 1"});
  }

  ErrorSummary
  rim_errors(const Pairing &pairing, const unsigned int p, const unsigned int n)
  {
    const std::string height = std::to_string(n / 2);
    const auto        across = [&](const unsigned int m) {
      return std::to_string(m) + ", " + std::to_string(m) + ", " + height;
    };
    return *run_scene(
              manufactured(),
              cells(pairing, p) + incompressible +
                Settings{"Exact solution/Displacement=0.1*sin(2*y + z); "
                         "0.1*cos(x - 2*z); 0.1*sin(x + y)",
                         "Exact solution/Pressure=20*cos(2*x)*sin(y + z)",
                         "Body lower/Mesh/Subdivisions=" + across(n),
                         "Body upper/Mesh/Subdivisions=" + across(3 * n / 2),
                         "Solver/Tolerance=1e-11"})
              .steps.back()
              .errors;
  }

  void
  check_rates()
  {
    // coarse meshes halved once are still before the limit
    constexpr RateSlack slack = {0.4, 0.5};
    for (const Pairing &pairing : {pairings[0], pairings[2]})
      for (const unsigned int p : {2, 3})
        {
          const std::string what =
            "clamped rim, " + pairing.slave + ", degree " + std::to_string(p);
          const ErrorSummary coarse = rim_errors(pairing, p, 2),
                             fine   = rim_errors(pairing, p, 4);
          rate_verdicts(what, p, coarse, fine, slack);
          verdict(what + ": pressure rate at least its degree + 1 - 0.4",
                  p - rate(*coarse.pressure_l2, *fine.pressure_l2),
                  0.4);
        }
  }

  ErrorSummary
  sphere_errors(const Settings &settings, const std::string &nu)
  {
    return *run_scene(two_layers(true),
                      settings +
                        of_both(layers, "Material/Poisson ratio=" + nu) +
                        of_both(layers, "Formulation=mixed") +
                        Settings{"Body inner/Mesh/Subdivisions=2, 1",
                                 "Body outer/Mesh/Subdivisions=3, 1"})
              .steps.back()
              .errors;
  }

  void
  check_all_ratios(const std::string &shape, const unsigned int p)
  {
    const std::string degree = std::to_string(p);
    const Settings    common = of_both(layers, "Degree=" + degree) +
                            of_both(layers, "Mesh/Cells=" + shape);
    const ErrorSummary standard = sphere_errors(common, "0.3");
    const std::string  name     = shape + ", degree " + degree;
    ErrorSummary       last;
    for (const std::string nu : {"0.49", "0.4999", "0.499999", "0.5"})
      {
        last             = sphere_errors(common, nu);
        const auto check = [&](const std::string           &what,
                               const std::optional<double> &a,
                               const std::optional<double> &b) {
          const double ratio = *a / *b;
          verdict(name + ", nu = " + nu + ": " + what +
                    " within a factor of 2 of nu = 0.3",
                  std::max(ratio, 1. / ratio),
                  2.);
        };
        check("L2 error", last.displacement_l2, standard.displacement_l2);
        check("H1 error", last.displacement_h1, standard.displacement_h1);
        check("pressure", last.pressure_l2, standard.pressure_l2);
        check("multiplier", last.multiplier_l2, standard.multiplier_l2);
      }
    const auto whole =
      *run_scene(
         "set Bodies = shell\n" + layer("shell", "1, 2", true, true) +
           "subsection Exact solution\n  set Displacement = thick sphere\nend\n"
           "subsection Output\n  set Directory = unused\n  set Fields =\nend\n",
         {"Body shell/Degree=" + degree,
          "Body shell/Material/Poisson ratio=0.5",
          "Body shell/Mesh/Cells=" + shape,
          "Body shell/Mesh/Subdivisions=2, 2"})
         .steps.back()
         .errors;
    verdict(name + ", nu = 0.5: H1 error within 1.1 of conforming",
            *last.displacement_h1 / *whole.displacement_h1,
            1.1);
    verdict(name + ", nu = 0.5: pressure within 1.1 of conforming",
            *last.pressure_l2 / *whole.pressure_l2,
            1.1);
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_patches();
  check_rates();
  check_all_ratios("hexahedra", 2);
  check_all_ratios("hexahedra", 4);
  check_all_ratios("tetrahedra", 2);
  check_all_ratios("tetrahedra", 3);
}
