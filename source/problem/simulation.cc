#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/base/interruption.h>
#include <mortise/problem/contact/contact_start.h>
#include <mortise/problem/guard.h>
#include <mortise/problem/results/points_outside.h>
#include <mortise/problem/results/result_checks.h>
#include <mortise/problem/results/run_table.h>
#include <mortise/problem/simulation.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    const char *const nothing_acts =
      "nothing acts on the scene; all results are zero. What acts: Traction, Pressure, "
      "Force, Moment or a Displacement other than zero on a boundary; Body force, Gravity "
      "with a Density, Temperature with a Thermal expansion in a body; Offset or Preload of "
      "an interface";

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
    : parameters(with_tolerance(given))
    , context{parameters, log, timers, comm}
    , steps(parameters.steps, false)
    , files(context)
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
    const bool first = discretisation == nullptr;
    if (bodies.empty())
      create_meshes();
    if (adaptivity && !summary.steps.empty())
      extend_search();
    const SceneData data(context.parameters, steps.next(), field_checks);
    if (!state.pressing && restart.empty())
      state.pressing = contact_start(context, steps.next(), bodies);
    // meshes of the last step do not suit the next one
    const bool again =
      adaptivity && adaptivity->n_cycles() == 0 && discretisation != nullptr;
    contact.reset();
    preloads.reset();
    solver.reset();
    discretisation.reset();
    if (again)
      create_meshes();
    else if (adaptivity)
      adaptivity->refine(bodies);
    discretisation =
      std::make_unique<Discretisation>(context,
                                       data,
                                       bodies,
                                       adaptivity ? adaptivity->degrees() :
                                                    CellDegrees());
    if (first)
      check_points(context, bodies);
    summary.balance = discretisation->interfaces().balance();

    const SolverParameters &given = context.parameters.solver;
    SolverOptions           options;
    options.method         = discretisation->choice().method;
    options.tolerance      = given.tolerance;
    options.max_iterations = given.max_iterations;
    options.max_gathered   = given.max_gathered;
    // steps of contact know themselves where to start
    if (context.parameters.steps.given() && !adaptivity &&
        !discretisation->interfaces().have_contact())
      options.successive = 4;
    if (given.print_iterations)
      options.monitor = [&](const unsigned int iteration,
                            const double       residual) {
        context.log.line("    iteration " + std::to_string(iteration) +
                         "  residual " + RunLog::number(residual));
      };
    solver   = make_linear_solver(discretisation->linear_system(), options);
    preloads = std::make_unique<Preloads>(context,
                                          *discretisation,
                                          *solver,
                                          state.shortenings);
    if (discretisation->interfaces().have_contact())
      contact = std::make_unique<ContactStep>(
        context, *discretisation, *solver, *preloads, state.pressing);
    // a factorisation gives one of many answers and does not tell
    if (options.method == SolverMethod::direct)
      discretisation->check_multipliers();
  }

  SystemVector
  Simulation::solve(const SceneData &data, SceneLoad &load)
  {
    preloads->begin(data, load);
    SystemVector                    solution;
    const std::vector<BodySolution> none;
    const auto &start = adaptivity ? adaptivity->start(bodies) : none;
    if (contact)
      report = contact->solve(load, solution);
    else if (start.empty())
      report = preloads->solve(false, load, solution);
    else
      {
        solution = discretisation->system_vector(start, load);
        report   = preloads->solve(true, load, solution);
      }
    if (!discretisation->choice().reason.empty())
      report.preconditioner += "; " + discretisation->choice().reason;
    if (!std::isfinite(report.relative_residual))
      report.converged = false;
    if (!report.converged)
      discretisation->check_multipliers();

    if (report.setup_seconds > 0.)
      {
        context.timers.add("solver_setup", report.setup_seconds);
        context.log.stage_line("solver_setup",
                               report.setup_seconds,
                               report.preconditioner);
      }
    context.timers.add("solve", report.solve_seconds);
    context.log.stage_line("solve",
                           report.solve_seconds,
                           report.method + ", " +
                             std::to_string(report.iterations) +
                             " iterations, residual " +
                             RunLog::number(report.relative_residual) +
                             (report.converged && report.attainable > 0. ?
                                ", all that rounding leaves with moduli and "
                                "sizes this different" :
                                ""));
    return solution;
  }

  StepSummary
  Simulation::summarise(const StepEvaluation &evaluation)
  {
    StepSummary result = discretisation->summary();
    if (context.parameters.steps.given())
      {
        result.step = steps.n_done() + 1;
        result.time = steps.next();
      }
    result.solver = {report.method,
                     report.preconditioner,
                     report.iterations,
                     report.relative_residual,
                     {},
                     {}};
    if (adaptivity)
      result.cycle = adaptivity->n_cycles() - 1;
    if (contact)
      {
        result.solver->active_sets       = contact->n_sets();
        result.solver->linear_iterations = contact->linear_iterations();
      }
    evaluate_step(evaluation, result);
    for (unsigned int j = 0; j < preloads->interfaces().size(); ++j)
      result.interfaces[preloads->interfaces()[j]].preload = {
        preloads->force(j, state.solution), preloads->shortenings()[j]};
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
        "lengths, moduli, loads and exact solution, or take other units");
    return result;
  }

  void
  Simulation::step(const bool writes)
  {
    const double    time = steps.next();
    const SceneData data(context.parameters, time, field_checks);
    if (!adaptivity)
      announce_step();
    SceneLoad load = discretisation->load(data);
    field_checks.throw_if_any(context.comm);
    check_loads(load.rhs);
    State next{time, solve(data, load), {}, {}};
    if (!report.converged && steps.halve())
      {
        context.log.line("  not converged: half the step");
        return;
      }

    if (contact)
      next.pressing = contact->active_places();
    next.shortenings = preloads->shortenings_by_interface();
    state            = std::move(next);
    const StepEvaluation evaluation(context,
                                    *discretisation,
                                    {data,
                                     load,
                                     state.solution,
                                     contact ? contact->undecided() :
                                               std::vector<bool>(),
                                     state.shortenings});
    {
      const auto stage = context.log.stage(context.timers, "postprocess");
      if (adaptivity)
        learn(evaluation);
      summary.steps.push_back(summarise(evaluation));
    }
    if (is_last_cycle())
      steps.accept(report.converged);
    if (writes)
      write_results(evaluation);
    if (context.parameters.steps.given() && is_last_cycle())
      print_progress();
  }

  void
  Simulation::announce_step() const
  {
    if (context.parameters.steps.given())
      context.log.line("step " + std::to_string(steps.n_done() + 1) +
                       ", t = " + RunLog::number(steps.next()));
  }

  void
  Simulation::march(const bool writes)
  {
    report.converged = true;
    if (parameters.adaptivity.target_error && !steps.finished())
      return adapt(writes);
    if (steps.finished()) // of a run that was continued
      context.log.line("the end at t = " + RunLog::number(steps.time()) +
                       " was reached before; another Steps/End time goes on");
    else
      discretise();
    if (!steps.finished() && !restart.empty())
      restore(restart);
    while (!steps.finished() && report.converged && unwritten.empty())
      step(writes);
    summary.status = !report.converged ? "not converged" :
                     !steps.finished() ? "stopped" :
                                         "done";
    if (!anything_acts(context.parameters) && is_zero(summary.steps.back()))
      context.log.warning(nothing_acts);
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
      }
    catch (const InputError &)
      {
        summary.status = "stopped";
        if (!report.method.empty() && !summary.steps.empty())
          {
            write_summary(); // steps of this run are worth keeping
            if (adaptivity)
              context.log.line("the results of cycle " +
                               std::to_string(summary.steps.back().cycle) +
                               " are written");
          }
        throw;
      }
    write_summary();
    print_table(context.log, summary.steps.back());
    if (!unwritten.empty())
      throw InputError(
        describe(unwritten) + "\n" +
        (summary.status != "stopped" ? "" :
         adaptivity                  ? "The run was stopped after cycle " +
                        std::to_string(summary.steps.back().cycle) + "; " :
                      "The run was stopped at t = " +
                        RunLog::number(steps.time()) + "; ") +
        interruption::what_is_complete());
    if (!report.converged)
      throw ConvergenceError(
        not_converged(report,
                      context.parameters.solver.tolerance,
                      contact && !contact->settled() ? contact->n_sets() : 0,
                      discretisation->choice().advice));
    if (adaptivity && !adaptivity->reached())
      throw ConvergenceError(missed(*adaptivity));
  }
} // namespace mortise
