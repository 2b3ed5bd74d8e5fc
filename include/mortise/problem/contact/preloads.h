// Ties that carry a given force, as the heads of bolts that are tightened: by
// how much the sides approach is one unknown for each, a part of the offset of
// the interface.
//
//     [  A    -w ] [ x ]   [ b ]
//     [ -w^T   0 ] [ d ] = [ F ]
//
// A is the system of LinearSolver, w = int psi . n of the interface, d its
// shortening, and -w^T lambda the normal force that it carries. One solution of
// A for each w gives the small matrix -w^T A^{-1} w, from which d follows.
#pragma once

#include <mortise/problem/scene/discretisation.h>
#include <mortise/solvers/linear_solver.h>

#include <optional>
#include <vector>

namespace mortise
{
  class Preloads
  {
  public:
    /// All must live on. Throws InputError for interfaces that are not about
    /// flat. @p shortenings: of an earlier one for the same interfaces, by interface, or none.
    /// Collective.
    Preloads(const RunContext          &run,
             const Discretisation      &discretisation,
             LinearSolver              &solver,
             const std::vector<double> &shortenings = {});

    /// By preloaded interface: by how much the sides approach, a length.
    const std::vector<double> &
    shortenings() const
    {
      return values;
    }

    /// Likewise of all interfaces, zero without a preload.
    std::vector<double>
    shortenings_by_interface() const;

    /// Index of the interface of each.
    const std::vector<unsigned int> &
    interfaces() const
    {
      return indices;
    }

    /// By interface of the scene: is its force given since begin(), and not its
    /// shortening?
    std::vector<bool>
    have_forces() const;

    /// What the given forces do along a motion that the constraint feels as @p opening.
    /// Collective.
    double
    work(const Vector &opening) const;

    /// The normal force that preloaded interface @p j carries, positive where it pulls the
    /// sides together. Collective.
    double
    force(unsigned int j, const SystemVector &x) const;

    /// Take the forces of the time of @p data, and the shortenings of the last solution into
    /// @p load.
    void
    begin(const SceneData &data, SceneLoad &load);

    /// As LinearSolver::solve(), or solve_from() if @p goes_on. The shortenings become part of
    /// @p load. What the shortenings move has to be held: Pairing::check_held(). Collective.
    SolveReport
    solve(bool goes_on, SceneLoad &load, SystemVector &x);

    /// Of @p z, a solution of the system of the solver for @p rhs: that of the
    /// system with the shortenings, which is symmetric, for no other loads and
    /// no forces. What it takes is added to @p report and @p rhs. Collective.
    void
    release(SystemVector &rhs, SystemVector &z, SolveReport &report);

  private:
    /// A solution for w, without other loads.
    struct Unit
    {
      SystemVector rhs, x;
    };

    /// The solutions for all w; their reports are added to @p report.
    void
    solve_units(SolveReport &report);
    /// For @p load without the shortenings, then what these bring: other loads
    /// start from those of earlier steps, beside which shortenings are large.
    SolveReport
    solve_other_loads(const SceneLoad &load, SystemVector &x);
    /// The part of what the constraint feels, @p opening, that is d w. Collective.
    double
    shortening(unsigned int j, const Vector &opening) const;
    /// Add d w to @p load, and to x what it brings.
    void
    shorten(unsigned int j, double d, SceneLoad &load, SystemVector *x);
    /// What the forces lack, by preloaded interface; zero where the shortening
    /// is kept.
    dealii::Vector<double>
    missing(const SystemVector &x) const;

    /// What the forces are short of by @p lacks. After solve_units().
    dealii::Vector<double>
    shortenings_for(const dealii::Vector<double> &lacks) const;

    const RunContext                  &run;
    const Discretisation              &discretisation;
    LinearSolver                      &solver;
    std::vector<unsigned int>          indices;
    std::vector<double>                values;
    std::vector<std::optional<double>> forces; ///< absent: kept shortening
    std::vector<Unit>                  units;
    std::optional<std::vector<bool>>   active; ///< of the units
    bool                               have_units = false;
  };
} // namespace mortise
