#include <mortise/problem/scene_solver.h>

#include <cmath>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    SolverOptions
    solver_options(const RunContext     &run,
                   const Discretisation &discretisation,
                   const bool            has_cycles)
    {
      const SolverParameters &given = run.parameters.solver;
      SolverOptions           options;
      options.method         = discretisation.choice().method;
      options.tolerance      = given.tolerance;
      options.max_iterations = given.max_iterations;
      options.max_gathered   = given.max_gathered;
      // steps of contact and Newton's method know themselves where to start
      if (run.parameters.steps.given() && !has_cycles &&
          !discretisation.interfaces().have_contact() &&
          !discretisation.linear_system().bulk->is_nonlinear())
        options.successive = 4;
      if (given.print_iterations)
        options.monitor = [&log = run.log](const unsigned int iteration,
                                           const double       residual) {
          log.line("    iteration " + std::to_string(iteration) +
                   "  residual " + RunLog::number(residual));
        };
      return options;
    }
  } // namespace

  SceneSolver::SceneSolver(const RunContext &run,
                           const SceneData  &data,
                           Bodies           &bodies,
                           const State      &last,
                           const CyclePlan  *cycle)
    : discretisation(run, data, bodies, cycle ? *cycle : CyclePlan())
    , linear_solver(
        make_linear_solver(discretisation.linear_system(),
                           solver_options(run, discretisation, cycle)))
    , unknowns(run, discretisation, *linear_solver)
    , run(run)
  {
    if (discretisation.interfaces().have_contact())
      contact = std::make_unique<ContactStep>(
        run, discretisation, *linear_solver, unknowns, last.contact);
    if (discretisation.linear_system().bulk->is_nonlinear())
      nonlinear = std::make_unique<NonlinearStep>(run,
                                                  discretisation,
                                                  *linear_solver,
                                                  unknowns);
    // a factorisation gives one of many answers and does not tell
    if (discretisation.choice().method == SolverMethod::direct)
      discretisation.check_multipliers();
  }

  void
  SceneSolver::resume(const SceneData   &data,
                      const SceneValues &values,
                      State             &state)
  {
    SceneLoad load = discretisation.load(data);
    if (discretisation.interfaces().follow())
      {
        discretisation.pair(values.solutions);
        discretisation.set_gaps(data, load);
        unknowns.pair_again();
        if (contact)
          contact = std::make_unique<ContactStep>(
            run, discretisation, *linear_solver, unknowns, state.contact);
      }
    unknowns.begin(data, state, load);
    state.solution = discretisation.system_vector(values, load);
    if (contact)
      contact->resume(load, state.solution);
    if (nonlinear)
      nonlinear->resume(load, values.solutions, values.increments, state);
    else if (!contact)
      linear_solver->remember(load.rhs, state.solution);
  }

  SolvedState
  SceneSolver::solve(const SceneData                 &data,
                     const State                     &last,
                     const std::vector<BodySolution> &start,
                     SceneLoad                       &load)
  {
    SolvedState  result;
    State       &next   = result.state;
    SolveReport &report = result.report;
    unknowns.begin(data, last, load);
    if (nonlinear)
      {
        State first;
        if (!start.empty())
          {
            first.solution = discretisation.system_vector(start, load);
            nonlinear->resume(load, start, {}, first);
          }
        report = nonlinear->solve(
          data, contact, load, start.empty() ? last : first, next);
      }
    else if (contact)
      {
        report = contact->solve(data,
                                load,
                                next.solution,
                                run.parameters.solver.tolerance);
        if (report.converged)
          contact->accept(load, next.solution);
      }
    else if (start.empty())
      report = unknowns.solve(false, load, next.solution);
    else
      {
        next.solution = discretisation.system_vector(start, load);
        report        = unknowns.solve(true, load, next.solution);
      }
    complete(result);
    return result;
  }

  SolvedState
  SceneSolver::solve(const PathStep &step, const State &last, SceneLoad &load)
  {
    SolvedState result;
    result.report = nonlinear->solve(step, load, last, result.state);
    complete(result);
    return result;
  }

  void
  SceneSolver::complete(SolvedState &solved)
  {
    State       &next   = solved.state;
    SolveReport &report = solved.report;
    if (!discretisation.choice().reason.empty())
      report.preconditioner += "; " + discretisation.choice().reason;
    if (!std::isfinite(report.relative_residual))
      report.converged = false;
    if (!report.converged)
      discretisation.check_multipliers();

    if (report.setup_seconds > 0.)
      {
        run.timers.add("solver_setup", report.setup_seconds);
        run.log.stage_line("solver_setup",
                           report.setup_seconds,
                           report.preconditioner);
      }
    run.timers.add("solve", report.solve_seconds);
    run.log.stage_line("solve",
                       report.solve_seconds,
                       report.method + ", " +
                         std::to_string(report.iterations) +
                         " iterations, residual " +
                         RunLog::number(report.relative_residual) +
                         (report.converged && report.attainable > 0. ?
                            ", all that rounding leaves with moduli and "
                            "sizes this different" :
                            ""));
    if (contact)
      next.contact = contact->records();
    unknowns.store(next);
  }

  void
  SceneSolver::summarise(const SolveReport  &report,
                         const SystemVector &solution,
                         StepSummary        &summary) const
  {
    summary.solver = {report.method,
                      report.preconditioner,
                      report.iterations,
                      report.relative_residual,
                      {},
                      {},
                      {}};
    if (contact && contact->n_sets() > 0)
      {
        summary.solver->active_sets       = contact->n_sets();
        summary.solver->linear_iterations = contact->linear_iterations();
      }
    if (nonlinear)
      {
        summary.solver->newton_iterations = nonlinear->report().iterations;
        summary.solver->linear_iterations =
          nonlinear->report().linear_iterations;
      }
    for (unsigned int j = 0; j < unknowns.interfaces().size(); ++j)
      summary.interfaces[unknowns.interfaces()[j]].preload = {
        unknowns.force(j, solution), unknowns.shortening(j)};
    const std::vector<Motion> motions = unknowns.motions();
    for (unsigned int p = 0; p < motions.size(); ++p)
      {
        const RigidPart  &part = unknowns.rigid_parts()[p];
        RigidPartSummary &of   = summary.rigid_parts.emplace_back();
        of.name                = part.name;
        for (unsigned int c = 0; c < dim; ++c)
          {
            of.point.push_back(part.where.centre[c]);
            of.displacement.push_back(motions[p][c]);
            of.rotation.push_back(180. / numbers::PI * motions[p][dim + c] /
                                  part.where.size);
          }
      }
    summary.periodic_cell = unknowns.cell(solution);
  }
} // namespace mortise
