// The composition root: a run from parameters to results. The members stand in
// the order of the data flow.
#pragma once

#include <mortise/problem/adaptive/adaptivity.h>
#include <mortise/problem/input/run_context.h>
#include <mortise/problem/load_steps.h>
#include <mortise/problem/results/step_results.h>
#include <mortise/problem/run_checkpoint.h>
#include <mortise/problem/run_output.h>
#include <mortise/problem/scene_solver.h>
#include <mortise/problem/state.h>

#include <memory>
#include <optional>
#include <string>

namespace mortise
{
  class Simulation
  {
  public:
    Simulation(const Parameters &parameters, RunLog &log, MPI_Comm comm);

    /// Open the meshes and check the parameters that refer to them; builds no
    /// spaces. Collective; throws InputError.
    void
    create_meshes();

    /// Check the scene without solving it: create_meshes(), the output
    /// directory and points. Collective; throws InputError.
    void
    validate();

    /// Continue from @p checkpoint, in @p directory: run() and compute() do the
    /// remaining steps. Throws InputError for one of another run or a damaged
    /// one.
    void
    resume(const RunCheckpoint &checkpoint, const std::string &directory);

    /// All steps up to errors and functionals; writes nothing. Collective;
    /// throws InputError.
    void
    compute();

    /// The whole run. Collective; throws InputError before anything is written,
    /// or after a step with an error of writing, ConvergenceError after the
    /// last result has been written, and interruption::Interrupted after the
    /// results and a checkpoint of the step in which a signal came.
    void
    run();

    /// Valid after compute().
    const Summary &
    result() const
    {
      return summary;
    }

  private:
    /// The next meshes, if there are cycles, and the equations on them.
    void
    discretise();
    /// All steps or cycles; with files if @p writes.
    void
    march(bool writes);
    /// Is nothing in the way of another step: an error of writing, or a signal?
    bool
    goes_on() const;
    /// "step 3, t = 0.6", or "cycle 2".
    std::string
    where() const;
    /// Step by step on one mesh.
    void
    run_steps(bool writes);
    /// Each step with adaptive cycles, from the mesh of the step before on.
    void
    run_cycles(bool writes);
    /// The cycles of one step.
    void
    cycle(bool writes);
    /// Plan of the next cycle: least search distances of contact by the
    /// relative motion of the last cycle, since cells become smaller than that.
    CyclePlan
    cycle_plan() const;
    bool
    is_last_cycle() const;
    /// Is the end time reached with arc-length control?
    bool
    ends_path() const;
    void
    announce_step() const;
    /// Why the last step of a scene with nonlinear laws did not converge, as a
    /// part of a sentence; empty if it did.
    std::string
    because() const;
    /// Of the state, whose time @p data and @p load are of; they must live on.
    StepEvaluation
    evaluate(const SceneData &data, const SceneLoad &load) const;
    /// If @p writes, the fields of the last step that did converge.
    void
    write_reached(bool writes);
    /// @p data becomes that of this time, too.
    SceneLoad
    load_at(double time, std::optional<SceneData> &data);
    /// The next step; @p data and @p load become those at its end.
    SolvedState
    solve_step(std::optional<SceneData> &data, std::optional<SceneLoad> &load);
    /// One step, which is halved if it does not converge and may be halved.
    void
    step(bool writes);
    /// The state at the end of the step. On the mesh of a cycle nonlinear laws
    /// go the way there from the beginning, or, where points remember nothing,
    /// from the solution of the cycle before; linear ones need but one solve.
    /// @p data and @p load: set to those of the end.
    SolvedState
    solve_in_cycle(std::optional<SceneData> &data,
                   std::optional<SceneLoad> &load);
    /// @p start: see SceneSolver::solve().
    SolvedState
    solve_at(double                           time,
             const State                     &last,
             const std::vector<BodySolution> &start,
             std::optional<SceneData>        &data,
             std::optional<SceneLoad>        &load);
    /// Set the state to that of the checkpoint in @p directory.
    void
    restore(const std::string &directory);
    /// Estimate the error of the cycle; for a quantity solve its dual problem.
    void
    estimate_error(const StepEvaluation &evaluation);
    StepSummary
    summarise(const StepEvaluation &evaluation);
    void
    write_results(const StepEvaluation &evaluation);

    const Parameters parameters;
    Timers           timers;
    const RunContext context;
    FieldChecks      field_checks; ///< of the scene

    LoadSteps                    steps;
    std::optional<LoadSteps>     steps_of_cycle; ///< of nonlinear laws
    std::string                  restart;        ///< directory of a checkpoint
    Bodies                       bodies;
    std::unique_ptr<SceneSolver> equations;
    std::optional<Adaptivity>    adaptivity; ///< with a target
    SolveReport                  report;     ///< of the last step
    int       stop_signal = 0; ///< that came while the last step was made
    State     state;
    Summary   summary;
    RunOutput output;
  };
} // namespace mortise
