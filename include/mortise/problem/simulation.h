// The composition root: a scene from parameters to results, step by step. Its
// members stand in the order in which data flows.
#pragma once

#include <mortise/problem/adaptive/adaptivity.h>
#include <mortise/problem/input/run_context.h>
#include <mortise/problem/load_steps.h>
#include <mortise/problem/run_checkpoint.h>
#include <mortise/problem/results/step_results.h>
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

    /// Open the meshes and check what depends on them; builds no spaces.
    /// Collective; throws InputError.
    void
    create_meshes();

    /// All that can be known of a scene before it is solved, coupling apart:
    /// create_meshes(), where results would go, and the points that are asked
    /// for. Collective; throws InputError.
    void
    validate();

    /// Go on from @p checkpoint, in @p directory: run() and compute() do the steps behind it.
    /// Throws InputError if it is of another run, or damaged.
    void
    resume(const RunCheckpoint &checkpoint, const std::string &directory);

    /// All steps up to errors and functionals; writes nothing. Collective;
    /// throws InputError.
    void
    compute();

    /// The whole run. Collective; throws InputError before anything is written,
    /// or after the first step of which something could not be written, when
    /// all that can be has been, and ConvergenceError after what was reached
    /// has been written.
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
    /// All that is asked for; with files if @p writes.
    void
    march(bool writes);
    /// Step by step on one mesh.
    void
    run_steps(bool writes);
    /// Each step with other meshes and degrees until the error is small enough,
    /// or no others are allowed, from the first mesh on.
    void
    run_cycles(bool writes);
    /// Likewise, one step.
    void
    cycle(bool writes);
    /// What the next cycle has beside the parameters: cells become smaller than
    /// what the sides of contact move, which are looked for as far as they have
    /// moved in the last one.
    CyclePlan
    cycle_plan() const;
    bool
    is_last_cycle() const;
    void
    announce_step() const;
    /// One step, or half of it if it does not converge and may be halved.
    void
    step(bool writes);
    /// Set the state to that of the checkpoint in @p directory.
    void
    restore(const std::string &directory);
    /// Estimate the error of the cycle, with a quantity by its dual problem.
    void
    estimate_error(const StepEvaluation &evaluation);
    StepSummary
    summarise(const StepEvaluation &evaluation);
    void
    write_results(const StepEvaluation &evaluation);

    const Parameters parameters;
    Timers           timers;
    const RunContext context;
    FieldChecks      field_checks; ///< of what is given

    LoadSteps                    steps;
    std::string                  restart; ///< directory of a checkpoint
    Bodies                       bodies;
    std::unique_ptr<SceneSolver> equations;
    std::optional<Adaptivity>    adaptivity; ///< with a target
    SolveReport                  report;     ///< of the last step
    State                        state;
    Summary                      summary;
    RunOutput                    output;
  };
} // namespace mortise
