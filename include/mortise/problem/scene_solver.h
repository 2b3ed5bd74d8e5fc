// Solver of the steps of a scene on given meshes: discretisation, linear
// solver, unknowns and active sets of contact.
#pragma once

#include <mortise/problem/contact/contact_step.h>
#include <mortise/problem/contact/global_unknowns.h>
#include <mortise/problem/nonlinear_step.h>
#include <mortise/problem/results/solved_step.h>
#include <mortise/problem/scene/discretisation.h>
#include <mortise/problem/state.h>
#include <mortise/solvers/solve.h>

#include <memory>
#include <string>
#include <vector>

namespace mortise
{
  /// A solved step without its time, and its report.
  struct SolvedState
  {
    State       state;
    SolveReport report;
  };

  class SceneSolver
  {
  public:
    /// @p run and @p bodies, which get their spaces, must live on. @p data: at any time; @p last: of the
    /// last step; @p cycle: null without cycles. Collective; throws InputError.
    SceneSolver(const RunContext &run,
                const SceneData  &data,
                Bodies           &bodies,
                const State      &last,
                const CyclePlan  *cycle);

    /// Go on from @p values, the solution of the time of @p data, which becomes
    /// part of @p state. Collective.
    void
    resume(const SceneData &data, const SceneValues &values, State &state);

    /// For @p load at the time of @p data, after @p last; global unknowns
    /// become part of @p load.
    /// @p start, by body, may be empty. Collective; throws InputError.
    SolvedState
    solve(const SceneData                 &data,
          const State                     &last,
          const std::vector<BodySolution> &start,
          SceneLoad                       &load);

    /// The same with arc-length control: @p load becomes that of the time that
    /// is reached. Collective; throws InputError.
    SolvedState
    solve(const PathStep &step, const State &last, SceneLoad &load);

    /// See NonlinearStep::linearise_at(); linear scenes are linearised anyway.
    void
    linearise_at(const State &state)
    {
      if (nonlinear)
        nonlinear->linearise_at(state);
    }

    /// Add the reports of the last solve(), with solution @p solution, to
    /// @p summary.
    void
    summarise(const SolveReport  &report,
              const SystemVector &solution,
              StepSummary        &summary) const;

    /// Of the last solve().
    SolvedContact
    solved_contact() const
    {
      return contact ? contact->solved() : SolvedContact();
    }

    /// Why Newton's method for nonlinear laws did not converge; empty if it
    /// did, and without such laws.
    std::string
    nonlinear_reason() const
    {
      return nonlinear && !nonlinear->report().converged ? nonlinear->reason() :
                                                           "";
    }

    /// Is that no matter of the step's length?
    bool
    has_no_answer() const
    {
      return !nonlinear_reason().empty() && nonlinear->has_no_answer();
    }

    /// Number of active sets of contact if they did not converge, else zero.
    unsigned int
    unconverged_sets() const
    {
      return contact && !contact->converged() ? contact->n_sets() : 0;
    }

    Discretisation                discretisation;
    std::unique_ptr<LinearSolver> linear_solver;
    GlobalUnknowns                unknowns;

  private:
    /// Check and report a solve, and add contact and unknowns to its state.
    void
    complete(SolvedState &solved);

    const RunContext            &run;
    std::unique_ptr<ContactStep> contact; ///< null without
    /// Null where all laws of material are linear.
    std::unique_ptr<NonlinearStep> nonlinear;
  };
} // namespace mortise
