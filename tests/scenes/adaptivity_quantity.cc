// Proves that a run whose target is of a quantity makes the error of that
// quantity what was asked for and says how large it is, at points and of
// resultants, on hexahedra and tetrahedra, with a pressure, where parts slide
// or press, beside a corner; that the dual problem is that of the quantity; and
// that wrong names are told. The same on any number of ranks.
#include <mortise/problem/adaptive/dual_solution.h>

#include "active_sets.h"
#include "scene.h"

using namespace mortise;
using namespace mortise::testing;

namespace
{
  Settings
  target(const std::string &quantity, const double error)
  {
    return {"Adaptivity/Quantity=" + quantity,
            "Adaptivity/Target error=" + number(error)};
  }

  const Settings shells = {
    "Body inner/Mesh/Subdivisions=3, 1",
    "Body outer/Mesh/Subdivisions=4, 2",
    "Output/Points=bore: inner: 1, 0, 0; rim: outer: 2, 0, 0; inside: "
    "inner: 0.75, 0.65, 0.6",
    "Output/Resultants=pull: inner: xmin; tied: inner: outside"};

  const Settings halves = {
    "Body lower/Mesh/Subdivisions=3, 3, 1",
    "Body upper/Mesh/Subdivisions=2, 2, 2",
    "Output/Points=tip: upper: 0.4, 0.6, 0.9; low: lower: 0.5, 0.5, 0.25",
    "Output/Resultants=pull: lower: zmin"};

  const Settings incompressible = {"Body inner/Degree=2",
                                   "Body outer/Degree=2",
                                   "Body inner/Material/Poisson ratio=0.5",
                                   "Body outer/Material/Poisson ratio=0.5"};

  const Settings tetrahedra = {"Body inner/Mesh/Cells=tetrahedra",
                               "Body outer/Mesh/Cells=tetrahedra"};

  /// The estimate of the last cycle is at most @p most times the error, and at least @p least times: the
  /// error has a sign, and may be small by chance.
  void
  check(const std::string &what,
        const std::string &text,
        const Settings    &settings,
        const double       least,
        const double       most)
  {
    const auto               summary = run_scene(text, settings);
    const AdaptivitySummary &last    = *summary.steps.back().adaptivity;
    verdict(what + ": status", summary.status == "done" ? 0. : 1., 0.);
    verdict(what + ": estimate", *last.estimate, last.target);
    verdict(what + ": error",
            *last.estimate / *last.effectivity,
            1.2 * last.target);
    verdict(what + ": too much by", *last.effectivity, most);
    verdict(what + ": too little by", 1. / *last.effectivity, 1. / least);
  }

  /// A change that continues is found with its sign, after all cells were cut.
  void
  check_correction()
  {
    const auto steps = run_scene(two_layers(true),
                                 shells + target("bore, x", 1e-2) +
                                   Settings{"Adaptivity/Strategy=h"})
                         .steps;
    const AdaptivitySummary &cut   = *steps[1].adaptivity;
    const double             exact = (0.4 + 4. * 1.3) / 70.;
    const double             error = exact - *cut.value;
    verdict("correction by h: relative",
            std::fabs(*cut.correction / error - 1.),
            0.5);
  }

  /// By symmetry: whatever is estimated, it has no relative error.
  void
  check_zero()
  {
    const auto summary =
      run_scene(two_layers(true), shells + target("bore, y", 1e-2));
    verdict("zero: told", summary.status == "target not reached" ? 0. : 1., 0.);
    verdict("zero: at once", summary.steps.size(), 2);
  }

  /// z . f is the quantity where nothing is prescribed but zero; and the
  /// functional is it.
  void
  check_dual(const std::string &what,
             const std::string &text,
             const Settings    &settings)
  {
    const MPI_Comm         comm = MPI_COMM_WORLD;
    const EquationsOfScene scene(text,
                                 settings + Settings{"Solver/Tolerance=1e-12"},
                                 comm);
    const auto            &discretisation = scene.discretisation;
    const Quantity         quantity       = *given_quantity(scene.given());
    SolverOptions          options;
    options.method    = discretisation.choice().method;
    options.tolerance = 1e-12;
    const auto solver =
      make_linear_solver(discretisation.linear_system(), options);
    SystemVector x, z;
    solver->solve(scene.load.rhs, x);
    const auto           u      = discretisation.solutions(scene.load, x);
    const SolvedStep     solved = scene.solved(x);
    const BoundaryForces forces(discretisation, solved, u);
    const double         value = all_components(quantity,
                                        discretisation.bodies(),
                                        u,
                                        forces)[quantity.component];
    const auto derivative = mortise::derivative(quantity, discretisation, u);
    solver->solve(derivative.rhs, z);
    const auto product = [](const SystemVector &a, const SystemVector &b) {
      double result = a.displacement * b.displacement;
      if (a.pressure.size() > 0)
        result += a.pressure * b.pressure;
      if (a.multiplier.size() > 0)
        result += a.multiplier * b.multiplier;
      return result;
    };
    double loads =
      0.; // where the function of a reaction is, which are no part of it
    for (unsigned int i = 0; i < derivative.lift.locally_owned_size(); ++i)
      loads +=
        derivative.lift.begin()[i] * scene.load.external.local_element(i);
    loads = dealii::Utilities::MPI::sum(loads, comm);
    verdict(what + ": derivative",
            std::fabs((product(derivative.rhs, x) - loads) / value - 1.),
            1e-9);
    verdict(what + ": dual",
            std::fabs((product(z, scene.load.rhs) - loads) / value - 1.),
            1e-8);
  }

  void
  check_duals()
  {
    const Settings cubic = {"Body inner/Degree=3", "Body outer/Degree=2"};
    for (const std::string name :
         {"bore, x", "inside, y", "pull, x", "tied, y"})
      {
        const Settings of = shells + target(name, 1e-3);
        check_dual(name, two_layers(true), of + cubic);
        check_dual(name + ", incompressible",
                   two_layers(true),
                   of + incompressible + cubic);
        check_dual(name + ", tetrahedra",
                   two_layers(true),
                   of + tetrahedra + cubic);
        check_dual(name + ", tetrahedra, incompressible",
                   two_layers(true),
                   of + tetrahedra + incompressible + cubic);
        check_dual(name + ", hanging nodes and degrees",
                   two_layers(true),
                   of + Settings{"Body inner/Mesh/Refine near=1, 0, 0, 0.3, 2",
                                 "Body inner/Degree near=1, 0, 0, 0.1, 4",
                                 "Body inner/Degree=2"});
      }
  }

  void
  check_names()
  {
    const std::string scene = two_layers(true);
    for (const std::string name :
         {"nowhere, x", "rim", "rim, w", ", x", "rim,"})
      check_message("wrong: " + name,
                    scene,
                    shells + target(name, 1e-2),
                    "one of bore, rim, inside, pull");
    check_message("nothing to name",
                  scene,
                  shells + target("rim, x", 1e-2) +
                    Settings{"Output/Points=", "Output/Resultants="},
                  "of which there is none");
    check_message("no target",
                  scene,
                  shells + Settings{"Adaptivity/Quantity=rim, x"},
                  "without Adaptivity/Target error");
    check_message("outside",
                  scene,
                  shells + Settings{"Output/Points=rim: outer: 2.5, 0, 0"} +
                    target("rim, x", 1e-2),
                  "lies outside of body");
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_names();
  check_duals();
  const std::string spheres = two_layers(true), blocks = manufactured();
  check("bore", spheres, shells + target("bore, x", 1e-4), 0.6, 100.);
  check("rim", spheres, shells + target("rim, x", 1e-5), 0.6, 100.);
  check("inside", spheres, shells + target("inside, z", 1e-4), 0.6, 100.);
  check("force", spheres, shells + target("pull, x", 1e-4), 0.6, 100.);
  check("rim, tetrahedra",
        spheres,
        shells + tetrahedra + target("rim, x", 1e-4),
        0.6,
        100.);
  check("rim, incompressible",
        spheres,
        shells + incompressible + target("rim, x", 1e-4),
        0.6,
        100.);
  check("manufactured", blocks, halves + target("tip, y", 1e-5), 0.6, 100.);
  check("its force", blocks, halves + target("pull, z", 1e-4), 0.6, 100.);
  const Settings pressed = {"Interface glue/Law=contact",
                            "Interface glue/Offset=-0.01"};
  check(
    "pressed", spheres, shells + pressed + target("rim, x", 1e-4), 0.6, 100.);
  const Settings corner = {
    "Body lower/Mesh/Subdivisions=2, 2, 2",
    "Body upper/Mesh/Subdivisions=3, 3, 1",
    "Output/Points=near: lower: 0.1, 0.12, 0.08",
    "Exact solution/Displacement=0.1*(x^2 + y^2 + z^2)^0.3; 0.05*(x^2 + "
    "y^2 + z^2)^0.3; 0"};
  check("beside a corner",
        two_boxes(),
        corner + target("near, x", 1e-3),
        0.6,
        100.);
  check_zero();
  check_correction();
}
