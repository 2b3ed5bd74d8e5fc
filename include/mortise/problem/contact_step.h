// One load step of a scene with contact: the active sets, each of which is a
// linear system, and what they cost.
#pragma once

#include <mortise/contact/active_set.h>
#include <mortise/contact/contact_edge.h>
#include <mortise/problem/discretisation.h>
#include <mortise/problem/run_context.h>
#include <mortise/solvers/linear_solver.h>

#include <cstdint>
#include <string>
#include <vector>

namespace mortise
{
  class ContactStep
  {
  public:
    /// All must live on. Collective.
    ContactStep(const RunContext &run,
                Discretisation   &discretisation,
                LinearSolver     &solver);

    /// Solve for @p load, first with the multipliers that press in @p last, the
    /// solution of the last step, or where it has no size with those whose gap
    /// is closed before anything moves; with all where these do not hold the
    /// bodies. On the way linear solves are as loose as the choice
    /// of the next set allows. The report is that of the last one, its seconds
    /// those of all; not converged after 100 sets. Throws InputError that names
    /// body and motion where contact is lost. Collective.
    SolveReport
    solve(const SceneLoad &load, const SystemVector &last, SystemVector &x);

    /// Of the last solve().
    unsigned int
    n_sets() const
    {
      return sets;
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
    void
    start(const SceneLoad &load, const SystemVector &last);
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
    solve_set(const SceneLoad &load, double tolerance, SystemVector &x);
    bool
    differs_from_shown() const;
    /// Let preconditioners see the set.
    void
    show();

    const RunContext &run;
    Discretisation   &discretisation;
    LinearSolver     &solver;
    ActiveSet         set;
    ContactEdge       edge;
    unsigned int      sets = 0, iterations = 0;
    std::vector<bool> shown; ///< the active ones that coarse levels see
    std::vector<bool> unclear;
    bool              is_shown = false;
    std::uint64_t     n_shown  = 0; ///< as ActiveSet::n_active()
  };
} // namespace mortise
