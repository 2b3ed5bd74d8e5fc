// Proves that bodies with axes are tied and solved as isotropic ones are:
// linear displacements exact through a non-matching interface between two
// orthotropic bodies and between one and an isotropic one, hexahedra and
// tetrahedra; rates of convergence with exact body forces; the isotropic answer
// from isotropic constants; the same answer with bodies and axes turned
// together; and the solvers agree. On every number of ranks.
#include <mortise/base/rigid_motion.h>
#include <mortise/material/material.h>

#include "scene.h"
#include "scenes.h"

using namespace mortise;
using namespace mortise::testing;
using dealii::Tensor;

namespace
{
  const Orthotropic fibres{{{900., 90., 45.}},
                           {{0.3, 0.4, 0.02}},
                           {{60., 20., 70.}},
                           {{20., -35., 70.}}};
  const Orthotropic layers{{{300., 200., 40.}},
                           {{0.2, 0.3, 0.05}},
                           {{110., 30., 25.}},
                           {{0., 15., 0.}}};

  std::string
  numbers(const std::array<double, 3> &values)
  {
    return number(values[0]) + ", " + number(values[1]) + ", " +
           number(values[2]);
  }

  Settings
  material(const std::string &body, const Orthotropic &law)
  {
    const std::string section = "Body " + body + "/Material/";
    return {section + "Law=orthotropic",
            section + "Young modulus=",
            section + "Poisson ratio=0.3",
            section + "Young moduli=" + numbers(law.young_moduli),
            section + "Poisson ratios=" + numbers(law.poisson_ratios),
            section + "Shear moduli=" + numbers(law.shear_moduli),
            section + "Axes=" + numbers(law.axes)};
  }

  /// A displacement G x that has the same traction across z = const in both
  /// materials: the slope in z follows from the others.
  Settings
  continuous_field(const Material &lower, const Material &upper)
  {
    Tensor<2, 3> G({{0.1, 0.03, 0.}, {0.01, 0.05, 0.}, {0.02, 0.06, 0.}});
    const auto   jump = [&](const Tensor<2, 3> &gradient) {
      const auto   s = lower.stress(gradient) - upper.stress(gradient);
      Tensor<1, 3> traction;
      for (unsigned int c = 0; c < 3; ++c)
        traction[c] = s[c][2];
      return traction;
    };
    Tensor<2, 3> A;
    for (unsigned int k = 0; k < 3; ++k)
      {
        Tensor<2, 3> slope;
        slope[k][2]       = 1.;
        const auto column = jump(slope);
        for (unsigned int c = 0; c < 3; ++c)
          A[c][k] = column[c];
      }
    const Tensor<1, 3> slope = -1. * (invert(A) * jump(G));
    std::string        text  = "Exact solution/Displacement=";
    for (unsigned int c = 0; c < 3; ++c)
      text += (c ? "; " : "") + number(G[c][0]) + "*x + " + number(G[c][1]) +
              "*y + " + number(slope[c]) + "*z";
    return {text};
  }

  void
  check_patch(const std::string &what,
              const Settings    &materials,
              const Settings    &field)
  {
    for (const std::string cells : {"hexahedra", "tetrahedra"})
      for (const unsigned int p : {1, 2, 3})
        for (const std::string method : {"condensed", "saddle point", "direct"})
          exact_verdicts(
            what + ", " + cells + ", degree " + std::to_string(p) + ", " +
              method,
            *run_scene(two_boxes(),
                       materials + field + both("Mesh/Cells=" + cells) +
                         both("Degree=" + std::to_string(p)) +
                         Settings{"Body lower/Mesh/Subdivisions=2, 2, 1",
                                  "Body upper/Mesh/Subdivisions=3, 3, 1",
                                  "Solver/Tolerance=1e-13",
                                  "Solver/Method=" + method})
               .steps.back()
               .errors);
  }

  StepSummary
  manufactured_step(const unsigned int p,
                    const unsigned int n,
                    const Settings    &settings)
  {
    const auto cells = [&](const unsigned int across) {
      return std::to_string(across) + ", " + std::to_string(across) + ", " +
             std::to_string(n / 2);
    };
    return run_scene(manufactured(),
                     both("Degree=" + std::to_string(p)) +
                       Settings{"Body lower/Mesh/Subdivisions=" + cells(n),
                                "Body upper/Mesh/Subdivisions=" +
                                  cells(3 * n / 2),
                                "Solver/Tolerance=1e-11"} +
                       settings)
      .steps.back();
  }

  void
  check_rates()
  {
    const Settings materials =
      material("lower", fibres) + material("upper", fibres);
    for (const std::string cells : {"hexahedra", "tetrahedra"})
      for (const unsigned int p : {1, 2, 3})
        {
          // on fewer tetrahedra the multiplier is before its limit, as with
          // isotropic bodies
          const unsigned int n =
            p == 1 || (p == 3 && cells == "tetrahedra") ? 4 : 2;
          const Settings settings = materials + both("Mesh/Cells=" + cells);
          rate_verdicts("orthotropic " + cells + ", degree " +
                          std::to_string(p),
                        p,
                        *manufactured_step(p, n, settings).errors,
                        *manufactured_step(p, 2 * n, settings).errors,
                        {0.3, 0.2});
        }
  }

  double
  difference(const StepSummary &a, const StepSummary &b)
  {
    const auto relative = [](const std::optional<double> &x,
                             const std::optional<double> &y) {
      return std::fabs(*x / *y - 1.);
    };
    return std::max(
      {relative(a.errors->displacement_l2, b.errors->displacement_l2),
       relative(a.errors->energy, b.errors->energy),
       relative(a.errors->multiplier_l2, b.errors->multiplier_l2)});
  }

  void
  check_isotropic_constants()
  {
    const LinearElastic hooke{900., 0.25};
    const double        E = hooke.young_modulus, nu = hooke.poisson_ratio,
                 G = hooke.lame_mu();
    const Orthotropic same{{{E, E, E}},
                           {{nu, nu, nu}},
                           {{G, G, G}},
                           {{20., 30., 40.}}};
    for (const std::string cells : {"hexahedra", "tetrahedra"})
      for (const std::string method : {"condensed", "direct"})
        {
          const Settings settings =
            both("Mesh/Cells=" + cells) + Settings{"Solver/Method=" + method};
          const StepSummary isotropic = manufactured_step(2, 2, settings),
                            got       = manufactured_step(2,
                                                    2,
                                                    settings +
                                                      material("lower", same) +
                                                      material("upper", same));
          const std::string what =
            "isotropic constants, " + cells + ", " + method;
          verdict(what + ": errors of the isotropic answer 1e-6",
                  difference(got, isotropic),
                  1e-6);
          if (method != "direct")
            verdict(what + ": iterations within 1",
                    std::fabs(double(*got.solver->iterations) -
                              double(*isotropic.solver->iterations)),
                    1.);
        }
  }

  void
  check_solvers()
  {
    const Settings materials =
      material("lower", fibres) + material("upper", fibres);
    for (const std::string cells : {"hexahedra", "tetrahedra"})
      {
        const Settings    settings = materials + both("Mesh/Cells=" + cells);
        const StepSummary direct =
          manufactured_step(3, 2, settings + Settings{"Solver/Method=direct"});
        for (const std::string method : {"condensed", "saddle point"})
          verdict(
            "orthotropic " + cells + ", " + method +
              " as the direct solver 1e-6",
            difference(manufactured_step(
                         3, 2, settings + Settings{"Solver/Method=" + method}),
                       direct),
            1e-6);
      }
  }

  /// The displacement at a corner of two tied boxes under pressure, with
  /// everything turned.
  Tensor<1, 3>
  corner(const std::string &cells, const std::array<double, 3> &degrees)
  {
    const RigidMotion motion(degrees, {{0., 0., 0.}});
    const auto        place = motion(dealii::Point<3>(1., 1., 1.));
    Orthotropic       lower = fibres, upper = layers;
    lower.axes = upper.axes = degrees;
    const std::string text =
      tied("lower, upper", "lower: zmax", "upper: zmin") +
      box("lower", "0, 0, 0, 1, 1, 0.5", "", "") +
      box("upper", "0, 0, 0.5, 1, 1, 1", "", "") +
      "subsection Body lower\n  subsection Boundary zmin\n"
      "    set Displacement = 0, 0, 0\n  end\nend\n"
      "subsection Body upper\n  subsection Boundary xmax\n"
      "    set Pressure = 3\n  end\n  subsection Boundary zmax\n"
      "    set Pressure = -5\n  end\nend\n";
    const Summary summary =
      run_scene(text,
                material("lower", lower) + material("upper", upper) +
                  both("Mesh/Cells=" + cells) + both("Degree=2") +
                  both("Mesh/Rotate=" + numbers(degrees)) +
                  Settings{"Body lower/Mesh/Subdivisions=2, 2, 1",
                           "Body upper/Mesh/Subdivisions=3, 3, 1",
                           "Solver/Tolerance=1e-12",
                           "Output/Points=corner: upper: " +
                             numbers({{place[0], place[1], place[2]}})});
    const std::vector<double> &u = summary.steps.back().quantities[0].second;
    return transpose(motion.rotation) * Tensor<1, 3>({u[0], u[1], u[2]});
  }

  void
  check_turned()
  {
    for (const std::string cells : {"hexahedra", "tetrahedra"})
      {
        const auto straight = corner(cells, {{0., 0., 0.}}),
                   turned   = corner(cells, {{25., -40., 110.}});
        verdict("bodies and axes turned together, " + cells + " 1e-8",
                (turned - straight).norm() / straight.norm(),
                1e-8);
      }
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const Settings two = material("lower", fibres) + material("upper", layers);
  check_patch("two orthotropic bodies", two, continuous_field(fibres, layers));
  check_patch("orthotropic on isotropic",
              material("upper", layers),
              continuous_field(LinearElastic{900., 0.25}, layers));
  check_isotropic_constants();
  check_solvers();
  check_turned();
  if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1)
    check_rates();
}
