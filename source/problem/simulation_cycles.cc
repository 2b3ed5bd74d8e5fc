// The cycles of Simulation: solve, estimate, refine, until the error is small
// enough.
#include <mortise/problem/adaptive/dual_solution.h>
#include <mortise/problem/simulation.h>

namespace mortise
{
  void
  Simulation::learn(const StepEvaluation &evaluation)
  {
    std::optional<DualSolution> dual;
    if (const auto &quantity = adaptivity->quantity())
      dual = solve_dual(context,
                        *discretisation,
                        *solver,
                        *preloads,
                        *quantity,
                        evaluation.solutions(),
                        evaluation.forces(),
                        adaptivity->dual_start(bodies));
    std::vector<InterfaceViolation> broken;
    Residuals                       missing;
    if (!dual)
      {
        broken  = violations(evaluation);
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

  void
  Simulation::extend_search()
  {
    constexpr double margin = 1.25; // the next solution moves otherwise
    for (const InterfaceSummary &of : summary.steps.back().interfaces)
      for (InterfaceParameters &given : parameters.interfaces)
        if (of.contact && given.name == of.name)
          given.search_distance.least = margin * of.contact->motion_max;
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
    while (!is_last_cycle() && unwritten.empty())
      {
        context.log.line("cycle " + std::to_string(adaptivity->n_cycles()));
        discretise();
        step(writes);
        if (adaptivity->errors().memory.estimate)
          context.log.line("  " + found(*adaptivity, bodies));
      }
  }

  void
  Simulation::adapt(const bool writes)
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
           adaptivity->reached() && !steps.finished() && unwritten.empty())
      {
        adaptivity.emplace(context);
        cycle(writes);
      }
    summary.status = !report.converged                       ? "not converged" :
                     !unwritten.empty() && !steps.finished() ? "stopped" :
                     adaptivity->reached()                   ? "done" :
                                             "target not reached";
  }
} // namespace mortise
