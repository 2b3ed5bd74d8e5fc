// Proves that the dual problem of a quantity sees the shortening of interfaces
// that carry a given force: it carries none there, its own shortening is the
// share of the force in the quantity, and estimates of bolted scenes are right.
// The same on any number of ranks.
#include <mortise/problem/adaptive/dual_solution.h>
#include <mortise/problem/contact/global_unknowns.h>

#include "active_sets.h"
#include "scene.h"
#include "scenes.h"

using namespace mortise;
using namespace mortise::testing;

namespace
{
  std::string
  bar(const std::string &name,
      const std::string &extent,
      const std::string &subdivisions,
      const double       modulus,
      const std::string &boundary,
      const std::string &condition)
  {
    return "subsection Body " + name +
           "\n  subsection Mesh\n    set Source = box\n    set Extent = " +
           extent + "\n    set Subdivisions = " + subdivisions +
           "\n  end\n  subsection Material\n    set Young modulus = " +
           number(modulus) + "\n  end\n  subsection Boundary " + boundary +
           "\n    set " + condition + "\n  end\nend\n";
  }

  const std::string clamped = "Displacement = 0, 0, 0";

  std::string
  tie(const std::string &name,
      const std::string &slave,
      const std::string &master,
      const std::string &force)
  {
    return "subsection Interface " + name + "\n  set Slave = " + slave +
           "\n  set Master = " + master +
           (force.empty() ? "" : "\n  set Preload = " + force) + "\nend\n";
  }

  /// A bolt from a ceiling, tightened onto a block.
  std::string
  bolt_on_block()
  {
    return "set Bodies = bolt, block\nset Interfaces = joint\n" +
           bar("bolt", "0, 0, 0, 1, 1, 2", "1, 1, 2", 1000., "zmax", clamped) +
           bar(
             "block", "-1, -1, -1, 2, 2, 0", "3, 3, 1", 500., "zmin", clamped) +
           tie("joint", "bolt: zmin", "block: zmax", "3") +
           "subsection Output\n  set Points = tip: bolt: 0.5, 0.5, 1\nend\n";
  }

  /// An arm on a spacer, which a bolt pulls down, with a load at its tip.
  std::string
  bolted_arm()
  {
    return "set Bodies = arm, spacer, bolt\nset Interfaces = seat, thread\n" +
           bar("arm",
               "0, 0, 0, 4, 1, 0.5",
               "4, 1, 1",
               1000.,
               "xmax",
               "Traction = 0; 0; -0.02") +
           bar("spacer",
               "0, 0, -1, 0.6, 1, 0",
               "1, 1, 1",
               500.,
               "zmin",
               clamped) +
           bar("bolt",
               "1, 0.25, -2, 1.5, 0.75, 0",
               "1, 1, 2",
               2000.,
               "zmin",
               clamped) +
           tie("seat", "spacer: zmax", "arm: zmin", "") +
           tie("thread", "bolt: zmax", "arm: zmin", "1") +
           "subsection Output\n  set Points = tip: arm: 4, 0.5, 0.25; "
           "middle: spacer: 0.3, 0.5, -0.3\n"
           "  set Resultants = foot: spacer: zmin\nend\n";
  }

  double
  product(const SystemVector &a, const SystemVector &b)
  {
    return a.displacement * b.displacement + a.multiplier * b.multiplier;
  }

  /// With A x = b + d w and A z = j + e w, w . x = -F and w . z = 0: the
  /// quantity is j . x = z . b + e F.
  void
  check_dual(const std::string &what,
             const std::string &text,
             const Settings    &settings)
  {
    const MPI_Comm         comm = MPI_COMM_WORLD;
    const EquationsOfScene scene(text,
                                 settings +
                                   Settings{"Solver/Tolerance=1e-12",
                                            "Adaptivity/Target error=0.1"},
                                 comm);
    const auto            &discretisation = scene.discretisation;
    SolverOptions          options;
    options.method    = discretisation.choice().method;
    options.tolerance = 1e-12;
    const auto solver =
      make_linear_solver(discretisation.linear_system(), options);
    solver->update();
    GlobalUnknowns unknowns(scene.context(), discretisation, *solver);
    SceneLoad      load = scene.load;
    SystemVector   x;
    unknowns.begin(scene.fields(), {}, load);
    unknowns.solve(false, load, x);
    const auto derivative =
      mortise::derivative(*given_quantity(scene.given()),
                          discretisation,
                          discretisation.solutions(load, x));
    SceneLoad    dual{derivative.rhs, {}};
    SystemVector z;
    SolveReport  report = solver->solve(dual.rhs, z);
    unknowns.release(unknowns.zero(), dual, z, report);
    verdict(what + ": converged", report.converged ? 0. : 1., 0.);
    const double value = product(derivative.rhs, x),
                 share = product(dual.rhs, x) - value; // - e F
    verdict(what + ": by loads and force",
            std::fabs((product(z, scene.load.rhs) - share) / value - 1.),
            1e-8);
    verdict(what + ": the force is seen", 1e-3, std::fabs(share / value));
    verdict(what + ": no force of the dual's",
            std::fabs(unknowns.force(0, z) * unknowns.shortening(0) / value),
            1e-9);
  }

  /// Beside @p value, of a run for a target of 2e-5 with a million unknowns.
  void
  check_run(const std::string &what,
            const std::string &quantity,
            const std::string &text,
            const double       target,
            const double       value)
  {
    const auto summary =
      run_scene(text,
                {"Adaptivity/Quantity=" + quantity,
                 "Adaptivity/Target error=" + number(target)});
    const AdaptivitySummary &last  = *summary.steps.back().adaptivity;
    const double             error = std::fabs(*last.value / value - 1.);
    verdict(what + ": status", summary.status == "done" ? 0. : 1., 0.);
    verdict(what + ": error", error, target);
    verdict(what + ": too much by", *last.estimate / error, 4.);
    verdict(what + ": too little by", error / *last.estimate, 2.);
    // at most 50,298; 100,000 and more where the dual saw no shortening
    verdict(what + ": unknowns", summary.steps.back().dofs.total, 70000.);
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const std::string degree : {"1", "3"})
    {
      const std::string of = ", degree " + degree;
      check_dual("bolt on a block" + of,
                 bolt_on_block(),
                 {"Adaptivity/Quantity=tip, z",
                  "Body bolt/Degree=" + degree,
                  "Body block/Degree=2"});
      for (const std::string quantity : {"tip, z", "middle, z", "foot, z"})
        check_dual("bolted arm, " + quantity + of,
                   bolted_arm(),
                   {"Adaptivity/Quantity=" + quantity,
                    "Body arm/Degree=2",
                    "Body bolt/Degree=" + degree});
    }
  check_run("bolt on a block", "tip, z", bolt_on_block(), 1e-2, -2.908724e-3);
  check_run("bolted arm", "tip, z", bolted_arm(), 3e-2, -0.2547255);
  check_run("its spacer", "middle, z", bolted_arm(), 1e-2, -2.332577e-3);
}
