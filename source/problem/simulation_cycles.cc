// The cycles of Simulation: solve, estimate, refine, until the error is small
// enough.
#include <mortise/operators/cells/cell_histories.h>
#include <mortise/problem/adaptive/dual_solution.h>
#include <mortise/problem/simulation.h>

#include <algorithm>

namespace mortise
{
  void
  Simulation::estimate_error(const StepEvaluation &evaluation)
  {
    std::optional<DualSolution> dual;
    if (const auto &quantity = adaptivity->quantity())
      {
        equations->linearise_at(state);
        dual = solve_dual(context,
                          equations->discretisation,
                          *equations->linear_solver,
                          equations->unknowns,
                          *quantity,
                          evaluation.solutions(),
                          evaluation.forces(),
                          adaptivity->dual_start(bodies));
      }
    auto            broken  = interface_residuals(evaluation);
    const Residuals missing = residuals(evaluation, broken);
    if (dual)
      broken.clear();
    adaptivity->add(
      bodies, evaluation.solutions(), dual, std::move(broken), missing);
    if (dual && !dual->report.converged)
      {
        report = dual->report;
        report.method += " of the dual problem";
      }
  }

  SolvedState
  Simulation::solve_in_cycle(std::optional<SceneData> &data,
                             std::optional<SceneLoad> &load)
  {
    const auto &start     = adaptivity->start(bodies);
    const auto  remembers = [](const auto &body) { return has_history(*body); };
    const bool  is_linear =
      !equations->discretisation.linear_system().bulk->is_nonlinear();
    SolvedState next;
    steps_of_cycle.reset();
    const Pairing &interfaces = equations->discretisation.interfaces();
    const bool     slips = interfaces.follow() && interfaces.have_friction();
    if (is_linear || (!start.empty() && !slips &&
                      std::none_of(bodies.begin(), bodies.end(), remembers)))
      next = solve_at(steps.next(), State(), start, data, load);
    if (is_linear || next.report.converged)
      return next;
    if (load)
      context.log.line("  not converged" + because() +
                       ": the path from the beginning");
    steps_of_cycle.emplace(parameters.steps, steps.next());
    for (State last; !steps_of_cycle->finished(); last = next.state)
      {
        while (!(next = solve_at(steps_of_cycle->next(), last, {}, data, load))
                  .report.converged)
          {
            const std::string where = because();
            if (!steps_of_cycle->halve())
              return next;
            context.log.line("  not converged" + where + ": half the step");
          }
        steps_of_cycle->accept(true);
        if (!steps_of_cycle->finished())
          context.log.line("  t = " + RunLog::number(steps_of_cycle->time()));
      }
    return next;
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
    while (!is_last_cycle() && goes_on())
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
    const bool after_step =
      adaptivity && parameters.steps.given() && !(state.time > steps.time());
    if (!adaptivity)
      adaptivity.emplace(context);
    else if (adaptivity->reached() && !parameters.steps.given())
      context.log.line("the target was reached before: " +
                       found(*adaptivity, bodies));
    else
      {
        create_meshes();
        adaptivity->restore_meshes(bodies);
        discretise();
        restore(restart);
      }
    if (after_step)
      adaptivity->begin_step(bodies);
    cycle(writes);
    while (parameters.steps.given() && report.converged &&
           adaptivity->reached() && !steps.finished() && goes_on())
      {
        adaptivity->begin_step(bodies);
        cycle(writes);
      }
    summary.status = !report.converged               ? "not converged" :
                     !goes_on() && !steps.finished() ? "stopped" :
                     adaptivity->reached()           ? "done" :
                                                       "target not reached";
  }
} // namespace mortise
