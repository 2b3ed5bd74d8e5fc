// Proves that the three methods give the same solution and multipliers, in any
// units, with prescribed jumps, bodies that hang on others, contrast and
// without an interface; that later solves start from earlier ones; and that
// failure is reported.
#include <mortise/base/error.h>
#include <scenes/active_sets.h>
#include <scenes/scene.h>
#include <scenes/solutions.h>

#include <cmath>
#include <limits>

using namespace mortise;
using namespace mortise::testing;

namespace
{
  /// Two blocks of other sizes and meshes under a traction that bends and
  /// twists them, the lower one held, the upper one by the tie or, without it, too. @p length,
  /// @p modulus: units.
  std::string
  blocks(const double length  = 1.,
         const double modulus = 900.,
         const bool   is_tied = true)
  {
    const auto box =
      [&](const std::string &name, const double below, const double above) {
        return "subsection Body " + name +
               "\n  set Degree = 2\n  subsection Mesh\n    set Source = box\n"
               "    set Extent = 0, 0, " +
               number(below * length) + ", " + number(length) + ", " +
               number(length) + ", " + number(above * length) +
               "\n    set Subdivisions = " +
               (name == "lower" ? "3, 3, 2" : "2, 2, 2") +
               "\n  end\n  subsection Material\n    set Young modulus = " +
               number(modulus) + "\n    set Poisson ratio = 0.3\n  end\nend\n";
      };
    const std::string x = "(x/" + number(length) + ")",
                      E = number(1e-3 * modulus);
    return (is_tied ? tied("lower, upper", "lower: zmax", "upper: zmin") :
                      "set Bodies = lower, upper\n") +
           box("lower", 0., 1.) + box("upper", 1., 1.7) +
           "subsection Body lower\n  subsection Boundary zmin\n"
           "    set Displacement = 0, 0, 0\n  end\nend\n" +
           std::string(is_tied ?
                         "" :
                         "subsection Body upper\n  subsection Boundary zmin\n"
                         "    set Displacement = 0, 0, 0\n  end\nend\n") +
           "subsection Body upper\n  subsection Boundary zmax\n"
           "    set Traction = " +
           E + "*sin(3*" + x + "), " + E + "*" + x + "^2, -" + E +
           "\n  end\nend\n";
  }

  class Scene
  {
  public:
    Scene(const std::string &text,
          const Settings    &settings,
          const std::string &method)
      : method(method)
      , equations(text,
                  settings + Settings{"Solver/Method=" + method},
                  MPI_COMM_WORLD)
    {}

    const BlockSystem &
    system() const
    {
      return equations.discretisation.linear_system();
    }

    const SystemVector &
    rhs() const
    {
      return equations.load.rhs;
    }

    std::unique_ptr<LinearSolver>
    solver(const unsigned int max_iterations = 500,
           const unsigned int successive     = 0) const
    {
      SolverOptions options;
      options.method         = equations.discretisation.choice().method;
      options.tolerance      = 1e-11;
      options.max_iterations = max_iterations;
      options.successive     = successive;
      return make_linear_solver(system(), options);
    }

    /// Coefficients of all bodies, which do not depend on the method.
    std::vector<BodySolution>
    fields(const SystemVector &x) const
    {
      return equations.discretisation.solutions(equations.load, x);
    }

    const std::string method;

  private:
    EquationsOfScene equations;
  };

  double
  difference(const mortise::Vector &a, const mortise::Vector &b)
  {
    mortise::Vector d(a);
    d -= b;
    return d.l2_norm() / std::max(b.l2_norm(), 1e-300);
  }

  void
  check_agreement(const std::string &name,
                  const std::string &text,
                  const Settings    &settings = {},
                  const double       residual = 1e-12)
  {
    const Scene  assembled(text, settings, "direct");
    SystemVector exact;
    const auto   report = assembled.solver()->solve(assembled.rhs(), exact);
    verdict(name + ": direct, residual", report.relative_residual, residual);
    for (const std::string method : {"condensed", "saddle point", "auto"})
      {
        const Scene  scene(text, settings, method);
        SystemVector x;
        const auto   result = scene.solver()->solve(scene.rhs(), x);
        verdict(name + ": " + method + ", converged",
                result.converged ? 0. : 1.,
                0.);
        verdict(name + ": " + method + ", residual",
                result.relative_residual,
                std::max(1e-11, residual));
        verdict(name + ": " + method + ", displacements 1e-8",
                relative_difference(scene.fields(x), assembled.fields(exact)),
                1e-8);
        if (scene.system().owned_multiplier.size() == 0)
          continue;
        verdict(name + ": " + method + ", multipliers 1e-7",
                difference(x.multiplier, exact.multiplier),
                1e-7);
        mortise::Vector jump(x.multiplier);
        scene.system().constraint.vmult(jump, x.displacement);
        jump -= scene.rhs().multiplier;
        if (method == std::string("condensed"))
          verdict(name + ": constraint to rounding",
                  jump.linfty_norm() / x.displacement.linfty_norm(),
                  1e-13);
      }
  }

  /// Iterations must not depend on units.
  void
  check_units()
  {
    for (const std::string method : {"condensed", "saddle point"})
      {
        SystemVector x;
        const Scene  plain(blocks(), {}, method),
          other(blocks(1e-3, 1e12), {}, method);
        const double a = plain.solver()->solve(plain.rhs(), x).iterations,
                     b = other.solver()->solve(other.rhs(), x).iterations;
        verdict("units: " + method + ", iterations differ by at most 1",
                std::fabs(a - b),
                1.);
      }
  }

  /// A later load that is a combination of earlier ones is solved at the start;
  /// one that is not is solved as by a new solver; after update() nothing is
  /// left of what was.
  void
  check_later_solves(const std::string &method)
  {
    const Scene scene(blocks(), {}, method),
      jump(blocks(),
           {"Body upper/Boundary zmax/Traction=", "Interface glue/Offset=0.1"},
           method);
    const auto   solver = scene.solver(500, 3);
    SystemVector x, y;
    solver->solve(scene.rhs(), x);
    solver->solve(jump.rhs(), y);
    SystemVector rhs = scene.rhs();
    scale(rhs, -2.5);
    add_scaled(rhs, 7., jump.rhs());
    const auto report = solver->solve(rhs, x);
    scene.solver()->solve(rhs, y);
    verdict(method + ": a combination of loads takes one iteration at most",
            method == "direct" ? 0. : report.iterations,
            1.);
    verdict(method + ": it is that of a new solver, 1e-8",
            difference(x.displacement, y.displacement),
            1e-8);
    verdict(method + ": multipliers likewise, 1e-7",
            difference(x.multiplier, y.multiplier),
            1e-7);
    verdict(method + ": no setup for later loads", report.setup_seconds, 0.);

    rhs.displacement = 0.;
    rhs.multiplier   = 0.;
    solver->solve(rhs, x);
    verdict(method + ": no load after loads, no displacement",
            x.displacement.l2_norm() + x.multiplier.l2_norm(),
            0.);

    solver->update();
    const auto again = solver->solve(scene.rhs(), x);
    scene.solver()->solve(scene.rhs(), y);
    verdict(method + ": after update() that of a new solver, 1e-8",
            difference(x.displacement, y.displacement) +
              (again.converged ? 0. : 1.),
            1e-8);
    verdict(method + ": which has to iterate",
            method == "direct" || again.iterations > 0 ? 0. : 1.,
            0.);
  }

  void
  check_failures()
  {
    for (const std::string method : {"condensed", "saddle point"})
      {
        const Scene  scene(blocks(), {}, method);
        SystemVector x;
        const auto   report = scene.solver(3)->solve(scene.rhs(), x);
        verdict(method + ": three iterations do not converge",
                report.converged ? 1. : 0.,
                0.);
        verdict(method + ": three iterations are reported",
                std::fabs(report.iterations - 3.) +
                  (report.relative_residual < 1. ? 0. : 1.),
                0.);
      }
    for (const std::string method : {"direct", "condensed", "saddle point"})
      {
        const Scene  scene(blocks(), {}, method);
        SystemVector rhs  = scene.system().zero_vector(), x;
        const auto   zero = scene.solver()->solve(rhs, x);
        verdict(method + ": no load, no displacement",
                x.displacement.l2_norm() + x.multiplier.l2_norm() +
                  (zero.converged ? 0. : 1.),
                0.);
        if (rhs.displacement.locally_owned_size() > 0)
          rhs.displacement.begin()[0] =
            std::numeric_limits<double>::quiet_NaN();
        verdict(method + ": not a number stops",
                scene.solver()->solve(rhs, x).converged ? 1. : 0.,
                0.);
      }
    bool thrown = false;
    try
      {
        solver_method_from_name("dirct");
      }
    catch (const InputError &)
      {
        thrown = true;
      }
    verdict("unknown method is refused", thrown ? 0. : 1., 0.);
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_agreement("tied", blocks());
  check_agreement("standard multipliers",
                  blocks(),
                  {"Interface glue/Multiplier=standard"});
  check_agreement("jump", blocks(), {"Interface glue/Offset=0.05 + 0.1*x"});
  // the residual is what rounding of the stiff body's forces leaves
  check_agreement("contrast 1e4",
                  blocks(),
                  {"Body upper/Material/Young modulus=9e6"},
                  1e-9);
  check_agreement("contrast 1e-4",
                  blocks(),
                  {"Body upper/Material/Young modulus=0.09"});
  check_agreement("tetrahedra",
                  blocks(),
                  {"Body lower/Mesh/Cells=tetrahedra",
                   "Body upper/Mesh/Cells=tetrahedra"});
  check_agreement("no interface", blocks(1., 900., false));
  check_units();
  for (const std::string method : {"direct", "condensed", "saddle point"})
    check_later_solves(method);
  check_failures();
}
