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
    /// All must live on. @p start: what presses first, or pressed in the last step, if that is known. Collective.
    ContactStep(const RunContext           &run,
                Discretisation             &discretisation,
                LinearSolver               &solver,
                Preloads                   &preloads,
                std::optional<ActivePlaces> start);

    /// Solve for @p load, of which shortenings of preloads become a part. The first set is what presses as the last steps go on, in the first step what
    /// the constructor was told, or where the gap is closed before anything
    /// moves; all where these do not hold the bodies. On the way linear solves
    /// are as loose as the choice of the next set allows. The report is that of
    /// the last one, its seconds those of all; not converged after 1000 sets.
    /// Throws InputError that names body and motion where contact is lost.
    /// Collective.
    SolveReport
    solve(SceneLoad &load, SystemVector &x);

    /// Go on from @p x, a solution for @p load that was found before, with what the constructor was told for the multipliers that press. Collective.
    void
    resume(const SceneLoad &load, const SystemVector &x);

    /// What presses now. Collective.
    ActivePlaces
    active_places() const;

    /// Of the last solve().
    unsigned int
    n_sets() const
    {
      return sets;
    }

    /// Of the last solve(): did the sets come to an end?
    bool
    settled() const
    {
      return report.converged || !report.linear.converged;
    }

    /// Of the last solve(), by owned multiplier: neither pressure nor gap.
    const std::vector<bool> &
    undecided() const
    {
      return unclear;
    }

    /// Of the last solve(), of all sets.
    unsigned int
    linear_iterations() const
    {
      return report.linear_iterations;
    }

  private:
    /// Of the last step that was solved.
    struct Solved
    {
      SystemVector      rhs, x;
      std::vector<bool> active;
    };

    /// Set @p x to what @p load should come to where steps go on; returns the set that
    /// follows from it, the first one of the step.
    std::vector<bool>
    predict(const SceneLoad &load, SystemVector &x);
    /// Choose the set that follows from @p x, and how exactly it is to be
    /// solved; returns the share of multipliers that change.
    double
    residual(const SystemVector &x) override;
    void
    linearise(const SystemVector &x) override;
    SolveReport
    solve(SystemVector &x) override;
    SolveReport
    solve_set(unsigned int max_iterations, SystemVector &x);
    /// Where @p next, which follows from @p x, leaves motions free, bodies fall until it does not.
    /// Throws InputError where nothing stops them.
    void
    catch_bodies(const SystemVector &x, ActiveSet &next) const;
    /// For the start of the next step.
    void
    remember(Solved now);
    /// Those that the multipliers leave, in words; nothing where they hold the
    /// bodies.
    std::string
    free_motions(const std::vector<bool> &active) const;
    void
    print(const ActiveSet::Change &change) const;
    /// Let preconditioners see the set.
    void
    show();

    const RunContext &run;
    Discretisation   &discretisation;
    LinearSolver     &solver;
    Preloads         &preloads;
    ActiveSet         set;
    MultiplierPlaces  places;
    ContactEdge       edge;
    std::uint64_t     n_contact; ///< multipliers that may press only

    std::optional<ActivePlaces> first; ///< what presses in the first step
    std::optional<Solved>       last;  ///< with steps
    SuccessiveSolutions
         increments; ///< from step to step, with the set of the last one
    bool mixed_increment = false; ///< was the set of the last but one another?
    std::unique_ptr<ScaledResidual> scaled; ///< their product

    SceneLoad        *load = nullptr; ///< of solve()
    NewtonReport      report;
    double            tolerance  = 0.; ///< of the next linear solve
    unsigned int      sets       = 0;
    unsigned int      iterations = 0; ///< of the last set
    std::vector<bool> unclear;
    /// Active multipliers of the set that coarse levels see.
    std::optional<std::uint64_t> n_shown;
    bool                         shows = false; ///< do they see the next one?
    bool cold = true; ///< does the first set of the step know little?
    /// Do sets that open go on up to where the edge of the contact is?
    bool         extends    = false;
    bool         extended   = false; ///< did one open?
    unsigned int overshoots = 0;     ///< sets that closed again
  };
} // namespace mortise
