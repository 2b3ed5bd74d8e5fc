// One load step of a scene with contact, as Newton's method sees it: an
// evaluation chooses the active set, a linearisation is the system of that set.
#pragma once

#include <mortise/contact/active_set.h>
#include <mortise/contact/contact_edge.h>
#include <mortise/problem/contact/preloads.h>
#include <mortise/problem/input/run_context.h>
#include <mortise/problem/scene/discretisation.h>
#include <mortise/solvers/linear_solver.h>
#include <mortise/solvers/newton.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mortise
{
  class ContactStep : private NonlinearProblem
  {
  public:
    /// References must live on. @p start: the first active set, or that of the
    /// last step, if known. Collective.
    ContactStep(const RunContext              &run,
                Discretisation                &discretisation,
                LinearSolver                  &solver,
                Preloads                      &preloads,
                std::optional<ActivePositions> start);

    /// Solve for @p load, of which shortenings of preloads become a part. The
    /// first set is extrapolated from the last steps; in the first step it is
    /// that of the constructor, or the closed gaps of the undeformed meshes;
    /// all multipliers if it leaves a rigid motion free. Before the last set
    /// linear solves are as loose as the choice of the next set allows. The
    /// report is that of the last one, its seconds those of all; not converged
    /// after 1000 sets. Throws InputError with body and motion if contact is
    /// lost. Collective.
    SolveReport
    solve(SceneLoad &load, SystemVector &x);

    /// Continue from @p x, an earlier solution for @p load, with the active set
    /// of the constructor. Collective.
    void
    resume(const SceneLoad &load, const SystemVector &x);

    /// The present active set. Collective.
    ActivePositions
    active_positions() const;

    /// Of the last solve().
    unsigned int
    n_sets() const
    {
      return sets;
    }

    /// Of the last solve(): did the active sets converge?
    bool
    converged() const
    {
      return report.converged || !report.linear.converged;
    }

    /// Of the last solve(), by owned multiplier: are pressure and gap zero to
    /// rounding?
    const std::vector<bool> &
    undecided() const
    {
      return undecided_multipliers;
    }

    /// Of the last solve(), of all sets.
    unsigned int
    linear_iterations() const
    {
      return report.linear_iterations;
    }

  private:
    /// The last solved step.
    struct Solved
    {
      SystemVector      rhs, x;
      std::vector<bool> active;
    };

    /// Extrapolate @p x to @p load from the last steps; returns the first set
    /// of the step.
    std::vector<bool>
    predict(const SceneLoad &load, SystemVector &x);
    /// Choose the set that follows from @p x, and how exactly it is to be
    /// solved; returns the fraction of multipliers that change.
    double
    residual(const SystemVector &x) override;
    void
    linearise(const SystemVector &x) override;
    SolveReport
    solve(SystemVector &x) override;
    SolveReport
    solve_set(unsigned int max_iterations, SystemVector &x);
    /// If @p next, which follows from @p x, leaves rigid motions free, move the
    /// bodies along their loads until gaps close. Throws InputError if none
    /// does.
    void
    catch_bodies(const SystemVector &x, ActiveSet &next) const;
    /// Keep the solution for the prediction of the next step.
    void
    remember(Solved now);
    /// The free rigid motions in words; empty without.
    std::string
    free_motions(const std::vector<bool> &active) const;
    void
    print(const ActiveSet::Change &change) const;
    /// Update the penalties of preconditioners to the set.
    void
    show();

    const RunContext   &run;
    Discretisation     &discretisation;
    LinearSolver       &solver;
    Preloads           &preloads;
    ActiveSet           set;
    MultiplierPositions positions;
    ContactEdge         edge;
    std::uint64_t       n_contact; ///< multipliers of contact

    std::optional<ActivePositions> first; ///< active set of the first step
    std::optional<Solved>          last;  ///< with steps
    SuccessiveSolutions
         increments; ///< from step to step, with the set of the last one
    bool mixed_increment =
      false; ///< did the last two steps have different sets?
    std::unique_ptr<ScaledResidual> scaled; ///< for the product of increments

    SceneLoad        *load = nullptr; ///< of solve()
    NewtonReport      report;
    double            tolerance  = 0.; ///< of the next linear solve
    unsigned int      sets       = 0;
    unsigned int      iterations = 0; ///< of the last set
    std::vector<bool> undecided_multipliers;
    /// Active multipliers of the set in the penalties of coarse levels.
    std::optional<std::uint64_t> n_shown;
    bool shows = false; ///< is the next one to be in these?
    bool cold  = true;  ///< is the first set of the step a poor guess?
    /// Are sets that open extended to the predicted edge of the contact?
    bool         extends    = false;
    bool         extended   = false; ///< did one open?
    unsigned int overshoots = 0;     ///< sets that closed again
  };
} // namespace mortise
