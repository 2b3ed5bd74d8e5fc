// Ties with a given normal force (bolt pretension), and periodic ties with a
// mean strain. The shortening of each of the former is an additional unknown,
// part of the offset of its interface, and so are components of the mean strain
// whose mean stress is given.
//
//     [  A    -w ] [ x ]   [ b ]
//     [ -w^T   0 ] [ d ] = [ F ]
//
// A is the system of LinearSolver, w = int psi . n of the interface, d its
// shortening, -w^T lambda its normal force; or w = sum over periodic ties of
// int psi . (e t) with the unit strain e and the translation t, d the mean
// strain, -w^T lambda the mean stress times the volume of the cell. One
// solution with A per w gives the Schur complement -w^T A^{-1} w of d. In
// Newton's method A is the tangent.
#pragma once

#include <deal.II/lac/full_matrix.h>

#include <mortise/output/summary.h>
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

    /// By interface, zero without a preload; then the mean strain.
    std::vector<double>
    shortenings_by_interface() const;

    /// Nothing without periodic ties. Collective.
    std::optional<PeriodicCellSummary>
    cell(const SystemVector &x) const;

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
    /// sides together; behind these, what mean strains do work with.
    /// Collective.
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
      for (Unit &unit : units)
        unit.known = false;
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
      bool         has_x = false, known = false; ///< in the present system
    };

    /// The solutions for all w with a force; their reports are added to @p report.
    void
    solve_units(SolveReport &report);
    /// Solve for @p load without shortenings, which start from earlier steps,
    /// then add the contribution of the shortenings.
    SolveReport
    solve_other_loads(const SceneLoad &load, SystemVector &x);
    /// The d of the part d w of the constraint residual @p opening. Collective.
    double
    shortening(unsigned int j, const Vector &opening) const;
    /// Add all d w to @p load and their solutions to @p x.
    void
    shorten(const dealii::Vector<double> &d, SceneLoad &load, SystemVector &x);
    /// Of a unit of the mean stress on the unit strain @p k of the cell.
    double
    work_of_stress(unsigned int k) const;
    /// Is a force given, and not all shortenings kept?
    bool
    has_force() const;
    double
    largest_force() const;
    /// That of which forces of @p x lack a part: the largest given one, or where
    /// all are zero those of the other loads and shortenings. Collective.
    double
    size_of_forces(const SystemVector &x) const;
    /// Throws InputError where mean strains that are free meet no resistance.
    void
    check_resistance(const dealii::FullMatrix<double> &stiffness) const;
    /// Missing forces by preloaded interface; zero if the shortening is kept.
    dealii::Vector<double>
    missing(const SystemVector &x) const;

    /// Changes of shortenings for the missing forces @p lacks of a solution for
    /// @p rhs. After solve_units().
    dealii::Vector<double>
    shortenings_for(const dealii::Vector<double> &lacks,
                    const SystemVector           &rhs) const;
    /// The constant pressure that an incompressible cell lacks to have the mean
    /// stress, and which solutions do not contain; it is taken from @p lacks.
    double
    take_pressure(dealii::Vector<double> &lacks) const;
    /// Find fluxes.
    void
    find_enclosure();
    /// Of what @p rhs lets flow out of an enclosure, the volume that is not made
    /// up for by free strains. Collective.
    double
    net_flux(const SystemVector &rhs) const;
    /// Throws InputError where the volume of an incompressible cell changes.
    void
    check_volume() const;

    const RunContext                  &run;
    const Discretisation              &discretisation;
    LinearSolver                      &solver;
    std::vector<unsigned int>          indices;     ///< of preloaded interfaces
    double                             volume = 0.; ///< of the cell, if any
    std::vector<double>                values;
    std::vector<std::optional<double>> forces; ///< absent: kept shortening
    std::vector<Unit>                  units;
    /// Of a cell that is filled with incompressible bodies, the pressure of one
    /// and its multipliers, and by unit what flows out with it, a volume; else
    /// absent and zero.
    std::optional<SystemVector>      enclosure;
    dealii::Vector<double>           fluxes;
    std::optional<std::vector<bool>> active; ///< set of the units
  };
} // namespace mortise
