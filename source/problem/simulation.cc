#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/base/interruption.h>
#include <mortise/base/quotes.h>
#include <mortise/problem/contact/contact_start.h>
#include <mortise/problem/guard.h>
#include <mortise/problem/results/points_outside.h>
#include <mortise/problem/results/result_checks.h>
#include <mortise/problem/results/run_table.h>
#include <mortise/problem/simulation.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    const char *const nothing_acts =
      "nothing acts on the scene; all results are zero. Loads are: Traction, Pressure, Force, Moment or a nonzero "
      "Displacement of a boundary; Body force, Gravity with a Density, Temperature with a Thermal expansion in a "
      "body; Offset or Preload of an interface; Mean strain or Mean stress of the Periodic cell";

    /// Do smaller steps help where one does not converge?
    bool
    is_nonlinear(const Parameters &parameters)
    {
      return parameters.steps.given() && !parameters.adaptivity.target_error &&
             (std::any_of(parameters.interfaces.begin(),
                          parameters.interfaces.end(),
                          [](const InterfaceParameters &interface) {
                            return is_one_sided(interface.law) ||
                                   interface.follows_bodies;
                          }) ||
              std::any_of(parameters.bodies.begin(),
                          parameters.bodies.end(),
                          [](const BodyParameters &body) {
                            return !is_linear(body.material);
                          }));
    }

    /// Are all displacements of @p step rounding beside the bodies?
    bool
    is_zero(const StepSummary &step)
    {
      constexpr double rounding = 1e-10;
      return std::all_of(step.bodies.begin(),
                         step.bodies.end(),
                         [&](const BodySummary &body) {
                           return body.displacement_max &&
                                  body.displacement_max->value <=
                                    rounding * std::cbrt(body.volume);
                         });
    }
  } // namespace

  Simulation::Simulation(const Parameters &given,
                         RunLog           &log,
                         const MPI_Comm    comm)
    : parameters(with_ramp(with_tolerance(given)))
    , context{parameters, log, timers, comm}
    , steps(parameters.steps, is_nonlinear(parameters))
    , output(context)
  {
    summary.program = program_info(Utilities::MPI::n_mpi_processes(comm));
    summary.title   = parameters.title;
  }

  void
  Simulation::create_meshes()
  {
    if (!anything_acts(context.parameters) &&
        !have_real_gaps(context.parameters))
      context.log.warning(nothing_acts);
    // says what a named exact solution needs of the bodies
    const SceneData data(context.parameters, steps.next(), field_checks);
    bodies = mortise::create_meshes(context);
  }

  void
  Simulation::validate()
  {
    check_output_directory(context.parameters, context.comm);
    create_meshes();
    for (const auto &body : bodies)
      for (const std::string &warning : body->mesh.warnings)
        context.log.warning("body " + body->name + ": " + warning);
    std::set<unsigned int> of_points;
    for (const PointQuantity &point : context.parameters.output.points)
      of_points.insert(point.body);
    for (const unsigned int b : of_points)
      create_space(context, *bodies[b]);
    check_points(context, bodies);
  }

  void
  Simulation::discretise()
  {
    const bool first = equations == nullptr;
    if (bodies.empty())
      create_meshes();
    const SceneData data(context.parameters, steps.next(), field_checks);
    if (!state.contact && restart.empty())
      state.contact = contact_start(context, steps.next(), bodies);
    equations.reset();
    if (adaptivity)
      adaptivity->refine(bodies);
    const CyclePlan plan = cycle_plan();
    equations            = std::make_unique<SceneSolver>(
      context, data, bodies, state, adaptivity ? &plan : nullptr);
    if (first)
      check_points(context, bodies);
    summary.balance = equations->discretisation.interfaces().balance();
  }

  StepSummary
  Simulation::summarise(const StepEvaluation &evaluation)
  {
    StepSummary result = equations->discretisation.summary();
    if (context.parameters.steps.given())
      {
        result.step = steps.n_done() + 1;
        result.time = state.time;
      }
    if (adaptivity)
      result.cycle = adaptivity->n_cycles() - 1;
    evaluate_step(evaluation, result);
    equations->summarise(report, state.solution, result);
    if (adaptivity)
      result.adaptivity = summary_of(*adaptivity,
                                     bodies,
                                     evaluation.solved.data.exact().get(),
                                     result.errors);
    field_checks.throw_if_any(context.comm);
    const std::string not_finite = first_not_finite(result);
    if (report.converged && !not_finite.empty())
      throw InputError(
        "The solver converged, but the numbers of the scene are too large or too small to "
        "compute with: " +
        not_finite + "; allowed: results whose squares are finite. Check " +
        "lengths, moduli, loads and exact solution, or take other units; a cell of finite strain that turns "
        "inside out between its points of integration has no stress there: take smaller ones");
    return result;
  }

  void
  Simulation::march(const bool writes)
  {
    report.converged = true;
    if (parameters.adaptivity.target_error && !steps.finished())
      run_cycles(writes);
    else
      run_steps(writes);
  }

  void
  Simulation::run_steps(const bool writes)
  {
    if (steps.finished()) // of a run that was continued
      context.log.line(
        "the end at t = " + RunLog::number(state.time) +
        " was reached before; another Steps/End time" +
        (parameters.steps.by_arc_length ? " or Number of steps" : "") +
        " goes on");
    else
      discretise();
    if (!steps.finished() && !restart.empty())
      restore(restart);
    while (!steps.finished() && report.converged && goes_on())
      step(writes);
    summary.status = !report.converged ? "not converged" :
                     !steps.finished() ? "stopped" :
                                         "done";
    if (!anything_acts(context.parameters) && !summary.steps.empty() &&
        is_zero(summary.steps.back()))
      context.log.warning(nothing_acts);
  }

  bool
  Simulation::goes_on() const
  {
    return output.unwritten().empty() && stop_signal == 0;
  }

  std::string
  Simulation::where() const
  {
    return adaptivity && !parameters.steps.given() ?
             "cycle " + std::to_string(summary.steps.back().cycle) :
             "step " + std::to_string(summary.steps.back().step) +
               (adaptivity ?
                  ", cycle " + std::to_string(summary.steps.back().cycle) :
                  "") +
               ", t = " + RunLog::number(state.time);
  }

  void
  Simulation::compute()
  {
    march(false);
  }

  void
  Simulation::run()
  {
    check_output_directory(context.parameters, context.comm);
    try
      {
        march(true);
        interruption::be_patient(false);
      }
    catch (const InputError &)
      {
        summary.status = "stopped";
        if (!report.method.empty() && !summary.steps.empty())
          {
            output.write_summary(
              summary); // steps of this run are worth keeping
            if (adaptivity)
              context.log.line("the results of cycle " +
                               std::to_string(summary.steps.back().cycle) +
                               " are written");
          }
        throw;
      }
    output.write_summary(summary);
    if (!summary.steps.empty())
      print_table(context.log, summary.steps.back());
    if (!output.unwritten().empty())
      throw InputError(
        describe(output.unwritten()) + "\n" +
        (summary.status != "stopped" ? "" :
         adaptivity                  ? "The run was stopped after cycle " +
                        std::to_string(summary.steps.back().cycle) + "; " :
                      "The run was stopped at t = " +
                        RunLog::number(state.time) + "; ") +
        interruption::what_is_complete());
    if (stop_signal != 0 && summary.status == "stopped")
      throw interruption::Interrupted(
        stop_signal,
        "interrupted by " + interruption::name_of_signal(stop_signal) +
          " after " + where() +
          ": its results and a checkpoint are written; to go on: mortise "
          "--restart " +
          file_in_quotes(parameters.output.directory));
    const std::string results =
      summary.steps.empty() ? ". No equilibrium was reached" :
      adaptivity            ? ". The results of cycle " +
                     std::to_string(summary.steps.back().cycle) +
                     " are written" :
                   ". The results up to t = " + RunLog::number(state.time) +
                     " are written";
    if (!report.converged && equations->has_no_answer())
      throw InputError("No equilibrium was found" + because() + results);
    if (!report.converged && !equations->nonlinear_reason().empty())
      throw ConvergenceError(
        "Newton's method did not converge" + because() + results +
        ". Take smaller steps (Steps/Step, Steps/Smallest step), or a "
        "smaller load: beyond a largest one there may be no equilibrium");
    if (!report.converged)
      throw ConvergenceError(
        not_converged(report,
                      context.parameters.solver.tolerance,
                      equations->unconverged_sets(),
                      equations->discretisation.choice().advice));
    if (adaptivity && !adaptivity->reached())
      throw ConvergenceError(missed(*adaptivity));
  }

  void
  Simulation::write_results(const StepEvaluation &evaluation)
  {
    // a later cycle may not come to its end, and has the same file
    const bool each_cycle = adaptivity && !parameters.steps.given();
    if (!report.converged || each_cycle ||
        (is_last_cycle() && steps.output_due()) || stop_signal != 0)
      output.write_fields(steps,
                          state.time,
                          evaluation,
                          adaptivity ? adaptivity->errors().by_cell() :
                                       NumbersByCell());
    if (report.converged && !steps.finished())
      output.write_running(summary);
    const unsigned int every = parameters.output.checkpoint_every;
    const bool         due =
      every != 0 &&
      ((adaptivity ? adaptivity->n_cycles() : steps.n_done()) % every == 0 ||
       steps.finished() || !output.unwritten().empty()); // it ends here
    if (!report.converged || !(due || stop_signal != 0))
      return;
    const RunCheckpoint checkpoint{
      std::filesystem::absolute(parameters.file).string(),
      parameters.assignments,
      steps.longest(),
      steps.n_done(),
      steps.time(),
      {state.time,
       {},
       {},
       {},
       {{}, state.path.tangent},
       state.contact,
       state.shortenings},
      adaptivity ? to_bytes(adaptivity->checkpoint()) : std::string(),
      summary.steps,
      output.files.written()};
    output.write_checkpoint(to_sections(checkpoint),
                            state.path,
                            evaluation,
                            bodies);
    summary.status = "running";
    output.write_summary(summary);
  }
} // namespace mortise
