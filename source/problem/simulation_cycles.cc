// The cycles of Simulation: solve, estimate, refine, until the error is small
// enough.
#include <mortise/problem/adaptive/dual_solution.h>
#include <mortise/problem/simulation.h>

namespace mortise
{
  void
  Simulation::estimate_error(const StepEvaluation &evaluation)
  {
    std::optional<DualSolution> dual;
    if (const auto &quantity = adaptivity->quantity())
      dual = solve_dual(context,
                        equations->discretisation,
                        *equations->linear_solver,
                        equations->preloads,
                        *quantity,
                        evaluation.solutions(),
                        evaluation.forces(),
                        adaptivity->dual_start(bodies));
    std::vector<InterfaceResidual> broken;
    Residuals                      missing;
    if (!dual)
      {
        broken  = interface_residuals(evaluation);
        missing = residuals(evaluation, broken);
      }
    adaptivity->add(
      bodies, evaluation.solutions(), dual, std::move(broken), missing);
    if (dual && !dual->report.converged)
      {
        report = dual->report;
        report.method += " of the dual problem";
      }
  }

  CyclePlan
  Simulation::cycle_plan() const
  {
    constexpr double margin = 1.25; // the next solution moves otherwise
    CyclePlan        plan;
    if (!adaptivity)
      return plan;
    plan.degrees = adaptivity->degrees();
    if (!summary.steps.empty())
      for (const InterfaceSummary &of : summary.steps.back().interfaces)
        if (of.contact)
          plan.least_search[of.name] = margin * of.contact->motion_max;
    return plan;
  }

  bool
  Simulation::is_last_cycle() const
  {
    return !adaptivity || !report.converged || adaptivity->reached() ||
           !adaptivity->limit().empty();
  }

  void
  Simulation::cycle(const bool writes)
  {
    announce_step();
    while (!is_last_cycle() && output.unwritten().empty())
      {
        context.log.line("cycle " + std::to_string(adaptivity->n_cycles()));
        discretise();
        step(writes);
        if (adaptivity->errors().memory.estimate)
          context.log.line("  " + found(*adaptivity, bodies));
      }
  }

  void
  Simulation::run_cycles(const bool writes)
  {
    if (!adaptivity)
      adaptivity.emplace(context);
    else if (adaptivity->reached())
      context.log.line("the target was reached before: " +
                       found(*adaptivity, bodies));
    else
      {
        create_meshes();
        adaptivity->restore_meshes(bodies);
        discretise();
        restore(restart);
      }
    cycle(writes);
    while (parameters.steps.given() && report.converged &&
           adaptivity->reached() && !steps.finished() &&
           output.unwritten().empty())
      {
        adaptivity.emplace(context);
        cycle(writes);
      }
    summary.status = !report.converged ? "not converged" :
                     !output.unwritten().empty() && !steps.finished() ?
                                         "stopped" :
                     adaptivity->reached() ? "done" :
                                             "target not reached";
  }
} // namespace mortise
