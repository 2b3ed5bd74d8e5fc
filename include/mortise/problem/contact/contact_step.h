// One load step of a scene with contact: the active sets, each of which is a
// linear system, and what they cost.
#pragma once

#include <mortise/contact/active_set.h>
#include <mortise/contact/contact_edge.h>
#include <mortise/problem/contact/preloads.h>
#include <mortise/problem/input/run_context.h>
#include <mortise/problem/scene/discretisation.h>
#include <mortise/solvers/linear_solver.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mortise
{
  class ContactStep
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

    /// Likewise: did the sets come to an end?
    bool
    settled() const
    {
      return is_settled;
    }

    /// Likewise, by owned multiplier: neither pressure nor gap.
    const std::vector<bool> &
    undecided() const
    {
      return unclear;
    }

    /// Likewise, of all sets.
    unsigned int
    linear_iterations() const
    {
      return iterations;
    }

  private:
    /// Of the last step that was solved.
    struct Solved
    {
      SystemVector      rhs, x;
      std::vector<bool> active;
    };

    /// Choose the first set, and where steps go on set @p x to what @p load
    /// should come to.
    void
    start(const SceneLoad &load, SystemVector &x);
    /// For the start of the next step.
    void
    remember(Solved now);
    /// Those that the multipliers leave, in words; nothing where they hold the
    /// bodies.
    std::string
    free_motions(const std::vector<bool> &active) const;
    void
    print(std::uint64_t            n_active,
          const ActiveSet::Change &change,
          unsigned int             n_iterations) const;
    struct Next
    {
      ActiveSet         set;
      ActiveSet::Change change;
      std::string       free; ///< motions that it leaves, in words
    };
    /// What follows from @p x. @p extends: up to where the edge of the contact is.
    Next
    advance(const SceneLoad    &load,
            const SystemVector &x,
            double              tolerance,
            bool                extends);
    SolveReport
    solve_set(SceneLoad &load, double tolerance, SystemVector &x);
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

    std::optional<ActivePlaces> first; ///< what presses in the first step
    std::optional<Solved>       last;  ///< with steps
    SuccessiveSolutions
         increments; ///< from step to step, with the set of the last one
    bool mixed_increment = false; ///< was the set of the last but one another?
    std::unique_ptr<ScaledResidual> residual; ///< their product

    unsigned int      sets = 0, iterations = 0;
    std::vector<bool> unclear;
    bool              is_settled = true;
    bool              is_shown   = false;
    bool          cold = true; ///< does the first set of the step know little?
    std::uint64_t n_shown = 0; ///< of the set that coarse levels see
  };
} // namespace mortise
