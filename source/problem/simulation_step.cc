// One step of Simulation: solved, evaluated and written.
#include <mortise/base/interruption.h>
#include <mortise/problem/results/result_checks.h>
#include <mortise/problem/simulation.h>

namespace mortise
{
  SceneLoad
  Simulation::load_at(const double time, std::optional<SceneData> &data)
  {
    data.emplace(context.parameters, time, field_checks);
    SceneLoad result = equations->discretisation.load(*data);
    field_checks.throw_if_any(context.comm);
    // gaps of displaced bodies may be rounding of any size
    if (!equations->discretisation.interfaces().follow())
      check_loads(result.rhs);
    return result;
  }

  SolvedState
  Simulation::solve_at(const double                     time,
                       const State                     &last,
                       const std::vector<BodySolution> &start,
                       std::optional<SceneData>        &data,
                       std::optional<SceneLoad>        &load)
  {
    load               = load_at(time, data);
    SolvedState result = equations->solve(*data, last, start, *load);
    result.state.time  = time;
    return result;
  }

  SolvedState
  Simulation::solve_step(std::optional<SceneData> &data,
                         std::optional<SceneLoad> &load)
  {
    if (!context.parameters.steps.by_arc_length)
      return solve_at(steps.next(), state, {}, data, load);
    load.emplace();
    SolvedState result =
      equations->solve({steps.next() - steps.time(),
                        context.parameters.steps.last_time(),
                        [&](const double time) { return load_at(time, data); }},
                       state,
                       *load);
    data.emplace(context.parameters, result.state.time, field_checks);
    return result;
  }

  bool
  Simulation::ends_path() const
  {
    return context.parameters.steps.by_arc_length &&
           state.time >= context.parameters.steps.last_time();
  }

  void
  Simulation::step(const bool writes)
  {
    // before the first step there is nothing to be kept
    interruption::be_patient(
      writes && (parameters.steps.given() || adaptivity.has_value()));
    std::optional<SceneData> data;
    std::optional<SceneLoad> load;
    SolvedState              next;
    if (adaptivity)
      next = solve_in_cycle(data, load);
    else
      do
        {
          if (load)
            context.log.line("  not converged" + because() + ": half the step");
          announce_step();
          next = solve_step(data, load);
        }
      while (!next.report.converged && steps.halve());
    report = std::move(next.report);
    if (!report.converged && !equations->nonlinear_reason().empty())
      return write_reached(writes);
    state                           = std::move(next.state);
    const StepEvaluation evaluation = evaluate(*data, *load);
    {
      const auto stage = context.log.stage(context.timers, "postprocess");
      if (adaptivity)
        estimate_error(evaluation);
      summary.steps.push_back(summarise(evaluation));
    }
    if (is_last_cycle())
      steps.accept(report.converged);
    if (ends_path())
      steps.finish();
    if (writes)
      {
        stop_signal = interruption::agreed_signal(context.comm);
        write_results(evaluation);
      }
    if (context.parameters.steps.given() && is_last_cycle())
      output.print_progress(steps);
  }

  std::string
  Simulation::because() const
  {
    const std::string reason = equations->nonlinear_reason();
    const bool        along  = context.parameters.steps.by_arc_length;
    return reason.empty() ?
             "" :
             " from t = " +
               RunLog::number(steps_of_cycle ? steps_of_cycle->time() :
                                               state.time) +
               (along ?
                  " along the path" :
                  " to " +
                    RunLog::number(
                      (steps_of_cycle ? *steps_of_cycle : steps).next())) +
               " (" + reason + ")";
  }

  void
  Simulation::write_reached(const bool writes)
  {
    if (!writes || adaptivity || steps.output_due() || summary.steps.empty())
      return; // states of other meshes were written with their cycles
    const SceneData data(context.parameters, state.time, field_checks);
    SceneLoad       load = equations->discretisation.load(data);
    equations->unknowns.begin(data, state, load);
    output.write_fields(steps,
                        state.time,
                        evaluate(data, load),
                        NumbersByCell());
  }

  StepEvaluation
  Simulation::evaluate(const SceneData &data, const SceneLoad &load) const
  {
    return StepEvaluation(context,
                          equations->discretisation,
                          {data,
                           load,
                           state.solution,
                           state.history,
                           equations->solved_contact(),
                           state.shortenings});
  }

  void
  Simulation::announce_step() const
  {
    if (context.parameters.steps.given())
      context.log.line(
        "step " + std::to_string(steps.n_done() + 1) +
        (context.parameters.steps.by_arc_length ?
           ", along the path from t = " + RunLog::number(state.time) :
           ", t = " + RunLog::number(steps.next())));
  }
} // namespace mortise
