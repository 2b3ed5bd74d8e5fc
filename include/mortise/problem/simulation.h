// The composition root: a scene from parameters to results, step by step. Its
// members stand in the order in which data flows.
#pragma once

#include <mortise/problem/adaptive/adaptivity.h>
#include <mortise/problem/contact/contact_step.h>
#include <mortise/problem/contact/preloads.h>
#include <mortise/problem/input/run_context.h>
#include <mortise/problem/load_steps.h>
#include <mortise/problem/results/field_files.h>
#include <mortise/problem/results/step_results.h>
#include <mortise/problem/run_checkpoint.h>
#include <mortise/problem/scene/discretisation.h>
#include <mortise/problem/state.h>
#include <mortise/solvers/solve.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

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
    /// What no step changes; of the next cycle, if there are cycles.
    void
    discretise();
    /// All steps, or cycles; with files if @p writes.
    void
    march(bool writes);
    /// Solve with other meshes and degrees until the error is small enough, or
    /// no others are allowed; every step from the first mesh on.
    void
    adapt(bool writes);
    /// Likewise, for one step.
    void
    cycle(bool writes);
    /// Cells become smaller than what the sides of contact move: it is looked
    /// for as far as they have moved in the last cycle.
    void
    extend_search();
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
    /// Shortenings of preloads become part of @p load.
    SystemVector
    solve(const SceneData &data, SceneLoad &load);
    /// Tell how the cycle changed the solution, and that of a quantity.
    void
    learn(const StepEvaluation &evaluation);
    StepSummary
    summarise(const StepEvaluation &evaluation);
    void
    print_progress();
    void
    write_results(const StepEvaluation &evaluation);
    void
    write_checkpoint(const StepEvaluation &evaluation);
    void
    write_summary();

    /// What was done after so many seconds; from where progress is estimated.
    struct Clock
    {
      double share = 0., seconds = 0.;
    };

    Parameters       parameters;
    Timers           timers;
    Clock            clock;
    const RunContext context;
    FieldChecks      field_checks; ///< of what is given

    LoadSteps                       steps;
    std::string                     restart; ///< directory of a checkpoint
    Bodies                          bodies;
    std::unique_ptr<Discretisation> discretisation;
    std::unique_ptr<LinearSolver>   solver;
    std::unique_ptr<Preloads>       preloads;
    std::unique_ptr<ContactStep>    contact;    ///< null without
    std::optional<Adaptivity>       adaptivity; ///< with a target
    SolveReport                     report;     ///< of the last step
    State                           state;
    Summary                         summary;
    FieldFiles                      files;
    std::vector<OutputError>        unwritten;
  };
} // namespace mortise
