// Ties with a given normal force (bolt pretension). The shortening of each, an
// additional unknown, is part of the offset of its interface.
//
//     [  A    -w ] [ x ]   [ b ]
//     [ -w^T   0 ] [ d ] = [ F ]
//
// A is the system of LinearSolver, w = int psi . n of the interface, d its
// shortening, -w^T lambda its normal force. One solution with A per w gives the
// Schur complement -w^T A^{-1} w of d. In Newton's method A is the tangent.
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
    /// References must live on. Throws InputError for interfaces that are not
    /// nearly flat. Collective.
    Preloads(const RunContext     &run,
             const Discretisation &discretisation,
             LinearSolver         &solver);

    /// By preloaded interface, a length.
    const std::vector<double> &
    shortenings() const
    {
      return values;
    }

    /// By interface; zero without a preload.
    std::vector<double>
    shortenings_by_interface() const;

    /// Indices of the preloaded interfaces.
    const std::vector<unsigned int> &
    interfaces() const
    {
      return indices;
    }

    /// By interface of the scene: is its force given since begin(), and not its
    /// shortening?
    std::vector<bool>
    have_forces() const;

    /// Work of the given forces on a motion with the constraint residual
    /// @p opening. Collective.
    double
    work(const Vector &opening) const;

    /// The normal force that preloaded interface @p j carries, positive where it pulls the
    /// sides together. Collective.
    double
    force(unsigned int j, const SystemVector &x) const;

    /// The interfaces have been paired again, so that multipliers are others.
    void
    pair_again();

    /// To @p load, which has none.
    void
    add_shortenings(SceneLoad &load) const;

    /// The system of the solver is another one, whatever its active set.
    void
    system_changed()
    {
      known = false;
    }

    /// Take the forces of the time of @p data, and the shortenings of the last
    /// solution, by interface or none yet, into @p load.
    void
    begin(const SceneData           &data,
          const std::vector<double> &shortenings,
          SceneLoad                 &load);

    /// The largest force that @p x lacks, relative to the largest given one.
    /// Collective.
    double
    lack(const SystemVector &x) const;

    /// Change @p dx, an increment from @p x by the solver's system, so that
    /// forces are met. The changes of shortenings become part of @p load, and
    /// their solves of @p report. Collective.
    void
    complete_increment(const SystemVector &x,
                       SceneLoad          &load,
                       SystemVector       &dx,
                       SolveReport        &report);

    /// As LinearSolver::solve(), or solve_from() if @p goes_on. The shortenings
    /// become part of @p load. There must be no free motion:
    /// Pairing::check_no_free_motion(). Collective.
    SolveReport
    solve(bool goes_on, SceneLoad &load, SystemVector &x);

    /// Change @p z, a solution of the solver's system for @p rhs, to that of
    /// the symmetric system with shortenings and zero forces. The changes are
    /// added to @p report and @p rhs. Collective.
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
    /// Solve for @p load without shortenings, which start from earlier steps,
    /// then add the contribution of the shortenings.
    SolveReport
    solve_other_loads(const SceneLoad &load, SystemVector &x);
    /// The d of the part d w of the constraint residual @p opening. Collective.
    double
    shortening(unsigned int j, const Vector &opening) const;
    /// Add d w to @p load and its solution to @p x.
    void
    shorten(unsigned int j, double d, SceneLoad &load, SystemVector *x);
    /// Is a force given, and not all shortenings kept?
    bool
    has_force() const;
    double
    largest_force() const;
    /// Missing forces by preloaded interface; zero if the shortening is kept.
    dealii::Vector<double>
    missing(const SystemVector &x) const;

    /// Changes of shortenings for the missing forces @p lacks. After
    /// solve_units().
    dealii::Vector<double>
    shortenings_for(const dealii::Vector<double> &lacks) const;

    const RunContext                  &run;
    const Discretisation              &discretisation;
    LinearSolver                      &solver;
    std::vector<unsigned int>          indices;
    std::vector<double>                values;
    std::vector<std::optional<double>> forces; ///< absent: kept shortening
    std::vector<Unit>                  units;
    std::optional<std::vector<bool>>   active; ///< set of the units
    bool have_units = false, known = false;    ///< and of the present system
  };
} // namespace mortise
