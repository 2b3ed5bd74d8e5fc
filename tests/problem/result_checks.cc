// Proves that a result that is no number is found whatever it belongs to, and
// that loads are scaled without rounding, refused where they cannot be.
#include <deal.II/base/mpi.h>

#include <mortise/problem/results/result_checks.h>
#include <mortise/solvers/linear_solver.h>
#include <mortise/solvers/solve.h>

#include <cmath>
#include <functional>
#include <limits>

#include "parameter_checks.h"

using namespace parameter_checks;

namespace
{
  /// Results of every kind, all of them numbers.
  StepSummary
  results()
  {
    StepSummary step;
    step.solver.emplace();
    step.errors = ErrorSummary{1., 1., 1., 1., 1.};
    step.bodies.resize(1);
    step.bodies[0].name             = "block";
    step.bodies[0].displacement_max = PeakSummary{0., {0., 0., 0.}};
    step.bodies[0].von_mises_max =
      StressPeakSummary{{0., {0., 0., 0.}}, 0., {}};
    step.interfaces.resize(2);
    for (InterfaceSummary &interface : step.interfaces)
      {
        interface.name                      = "glue";
        interface.worst_face_coverage_error = 0.;
        interface.partition_of_unity_error  = 0.;
        interface.force_residual            = 0.;
        interface.moment_residual           = 0.;
        interface.linear_completeness_error = 0.;
      }
    step.quantities = {{"tip", {1., 2., 3.}}, {"outside", {}}};
    return step;
  }

  void
  test_results()
  {
    verdict(first_not_finite(results()).empty() &&
              first_not_finite(StepSummary()).empty(),
            "results that are numbers, or absent");
    const double nan = std::numeric_limits<double>::quiet_NaN(),
                 inf = std::numeric_limits<double>::infinity();
    const std::vector<
      std::pair<std::string, std::function<void(StepSummary &)>>>
      places = {
        {"relative residual = nan",
         [&](StepSummary &s) { s.solver->relative_residual = nan; }},
        {"body block, volume = inf",
         [&](StepSummary &s) { s.bodies[0].volume = inf; }},
        {"body block, largest displacement = nan",
         [&](StepSummary &s) { s.bodies[0].displacement_max->value = nan; }},
        {"body block, largest von Mises stress = inf",
         [&](StepSummary &s) { s.bodies[0].von_mises_max->value = inf; }},
        {"body block, averaged von Mises stress = nan",
         [&](StepSummary &s) { s.bodies[0].von_mises_max->averaged = nan; }},
        {"L2 error of the displacement = inf",
         [&](StepSummary &s) { s.errors->displacement_l2 = inf; }},
        {"H1 error of the displacement = inf",
         [&](StepSummary &s) { s.errors->displacement_h1 = inf; }},
        {"error in energy = inf",
         [&](StepSummary &s) { s.errors->energy = inf; }},
        {"L2 error of the pressure = inf",
         [&](StepSummary &s) { s.errors->pressure_l2 = inf; }},
        {"L2 error of the multiplier = nan",
         [&](StepSummary &s) { s.errors->multiplier_l2 = nan; }},
        {"interface glue, slave area = inf",
         [&](StepSummary &s) { s.interfaces[1].slave_area = inf; }},
        {"interface glue, force residual = nan",
         [&](StepSummary &s) { s.interfaces[1].force_residual = nan; }},
        {"interface glue, moment residual = nan",
         [&](StepSummary &s) { s.interfaces[1].moment_residual = nan; }},
        {"tip = -inf",
         [&](StepSummary &s) { s.quantities[0].second[2] = -inf; }}};
    for (const auto &[expected, spoil] : places)
      {
        StepSummary step = results();
        spoil(step);
        verdict(first_not_finite(step) == expected,
                expected,
                first_not_finite(step));
      }
  }

  void
  test_loads()
  {
    SystemVector rhs;
    rhs.displacement.reinit(dealii::complete_index_set(3), MPI_COMM_SELF);
    verdict(unit_scale(rhs) == 1. &&
              message_of([&] { check_loads(rhs); }) == "(no error)",
            "no loads");
    for (const double load : {1e-100, 0.1, 1., 3e7, 1e100})
      {
        rhs.displacement[1] = -load;
        const double factor = unit_scale(rhs);
        scale(rhs, factor);
        const double scaled = -rhs.displacement[1];
        scale(rhs, 1. / factor);
        std::ostringstream what;
        what << "a load of " << load;
        verdict(scaled >= 0.5 && scaled <= 1. && rhs.displacement[1] == -load &&
                  message_of([&] { check_loads(rhs); }) == "(no error)",
                what.str());
      }
    for (const double load : {1e-101, 1e-320, 1e101, 1e200})
      {
        rhs.displacement[1] = load;
        std::ostringstream what;
        what << "at most " << load << "; allowed: 0, or from 1e-100 to 1e+100";
        check_message(what.str(),
                      [&] { check_loads(rhs); },
                      {what.str(), "other units"});
      }
  }
  /// Messages of solves without convergence: the reason, and no useless advice.
  void
  test_not_converged()
  {
    SolveReport report;
    report.method            = "condensed";
    report.relative_residual = 1.;
    report.prepared          = false;
    const auto has = [](const std::string &text, const std::string &part) {
      return text.find(part) != std::string::npos;
    };
    std::string text = not_converged(report, 1e-10, 0, "");
    verdict(has(text, "could not be set up") && has(text, "direct") &&
              !has(text, "Max iterations"),
            "a set-up that failed",
            text);
    report.method = "direct";
    text          = not_converged(report, 1e-10, 0, "");
    verdict(has(text, "could not be set up") && !has(text, "Method"),
            "a factorisation that failed",
            text);
    report.prepared = true;
    text            = not_converged(report, 1e-10, 1001, "");
    verdict(has(text, "1001 active sets") && !has(text, "Max iterations"),
            "sets without end",
            text);
    verdict(has(not_converged(report, 1e-10, 0, ""),
                "Raise Solver/Max iterations"),
            "too few iterations");
    report.method = "saddle point";
    const SceneSize on_soft_springs{1000, false, 1., 1e10};
    const auto      advice = [&](const SolverMethod asked) {
      return choose_solver(asked, on_soft_springs).advice;
    };
    text = not_converged(report, 1e-10, 0, advice(SolverMethod::saddle_point));
    verdict(has(text, "auto, which here is direct (chosen since springs"),
            "a method that another one is better than",
            text);
    verdict(advice(SolverMethod::direct).empty() &&
              advice(SolverMethod::automatic).empty(),
            "no advice to take what was taken");
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_results();
  test_not_converged();
  test_loads();
  return 0;
}
