// Unknowns of the whole scene: the shortenings of ties with a given normal
// force (bolt pretension), each a part of the offset of its interface; the
// components of the mean strain of a periodic cell whose mean stress is given;
// and the motions of rigid parts, prescribed displacements that follow from
// equilibrium.
//
//     [  A    -w ] [ x ]   [ b ]
//     [ -w^T   c ] [ d ] = [ F ]
//
// A is the system of LinearSolver. Of a shortening w = int psi . n of the
// interface, and -w^T lambda is its normal force; of a strain w = sum over
// periodic ties of int psi . (e t) with the unit strain e and the translation
// t, and -w^T lambda is the mean stress times the volume of the cell; of a
// motion with the displacements R of the part, which are prescribed in A, w =
// -A R, c = R^T A R, and F are the loads R^T f on it. One solution with A per w
// gives the Schur complement c - w^T A^{-1} w of d. In Newton's method A is the
// tangent.
#pragma once

#include <deal.II/lac/full_matrix.h>

#include <mortise/output/summary.h>
#include <mortise/problem/scene/discretisation.h>
#include <mortise/problem/state.h>
#include <mortise/solvers/linear_solver.h>

#include <functional>
#include <optional>
#include <vector>

namespace mortise
{
  class GlobalUnknowns
  {
  public:
    /// References must live on. Throws InputError for interfaces with a preload
    /// that are not nearly flat. Collective.
    GlobalUnknowns(const RunContext     &run,
                   const Discretisation &discretisation,
                   LinearSolver         &solver);

    /// Of the preloaded interface @p j, a length.
    double
    shortening(const unsigned int j) const
    {
      return values[j];
    }

    /// Of the periodic cell; nothing without periodic ties. Collective.
    std::optional<PeriodicCellSummary>
    cell(const SystemVector &x) const;

    /// By rigid part, as of the last begin().
    const std::vector<RigidPart> &
    rigid_parts() const
    {
      return parts;
    }
    const std::vector<Motion> &
    motions() const
    {
      return at;
    }

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

    /// No change, by unknown.
    std::vector<double>
    zero() const
    {
      return std::vector<double>(all.size(), 0.);
    }

    /// Motion @p k of @p free, by unknown; zero for shortenings.
    std::vector<double>
    values_of(const FreeMotions &free, unsigned int k) const;

    /// Work of the given forces on changes @p d of the unknowns, and on a motion with
    /// the constraint residual @p opening. Collective.
    double
    work(const std::vector<double> &d, const Vector &opening) const;

    /// Add the gaps of changes @p d to @p gaps.
    void
    add_gaps(const std::vector<double> &d, double factor, Vector &gaps) const;

    /// The normal force that preloaded interface @p j carries, positive where it pulls the
    /// sides together. Collective.
    double
    force(unsigned int j, const SystemVector &x) const;

    /// The interfaces have been paired again, so that multipliers are others.
    /// Collective.
    void
    pair_again();

    /// To @p load, which has none.
    void
    add_shortenings(SceneLoad &load) const;

    /// The system of the solver is another one, whatever its active set.
    void
    system_changed()
    {
      for (Unknown &unknown : all)
        unknown.has_lift = unknown.known = false;
    }

    /// Take the forces and motions of the time of @p data, and the unknowns of
    /// @p last, into @p load. Collective; throws InputError.
    void
    begin(const SceneData &data, const State &last, SceneLoad &load);

    /// Those of @p state.
    void
    store(State &state) const;

    /// The largest force that @p x lacks, relative to the largest given one; of
    /// motions to the forces there are, or to those that belong to the root of
    /// an energy @p reference. Collective.
    double
    lack(const SystemVector &x, double reference) const;

    /// Go back to the values of begin(), in @p load, too. Collective.
    void
    go_back(SceneLoad &load);

    bool
    has_motions() const
    {
      return all.size() > first_motion;
    }

    /// Forces on the nodes, also at constrained components.
    struct NodalForces
    {
      Vector external, internal, of_multipliers;
    };

    /// In Newton's method: the loads of motions are those of an iterate with @p forces
    /// on its nodes. Collective.
    void
    take_forces(const NodalForces &forces);

    /// The same of the next linear problem, whose unknown is the iterate, which
    /// is @p moved without multipliers, plus its increment. Collective.
    void
    count_from(const SystemVector &moved);

    /// Change @p dx, an increment from @p x by the solver's system with the
    /// @p rest of prescribed displacements, so that forces are met. The changes of
    /// unknowns become part of @p load, and their solves of @p report.
    /// Collective.
    void
    complete_increment(const SystemVector &x,
                       const Vector       &rest,
                       SceneLoad          &load,
                       SystemVector       &dx,
                       SolveReport        &report);

    /// Let @p load have the displacements of motions that turn far, of which it has
    /// increments. Collective.
    void
    settle(SceneLoad &load) const;

    /// As LinearSolver::solve(), or solve_from() if @p goes_on. The unknowns
    /// become part of @p load. There must be no free motion:
    /// Pairing::check_no_free_motion(). Collective.
    SolveReport
    solve(bool goes_on, SceneLoad &load, SystemVector &x);

    /// A functional of a motion: of the displacements that it prescribes, and
    /// the forces by node of these.
    using Functional =
      std::function<double(const PrescribedValues &, const Vector &)>;
    /// By unknown; zero for shortenings. Collective.
    std::vector<double>
    on_motions(const Functional &functional) const;

    /// Change @p z, a solution of the solver's system for @p load, to that of
    /// the symmetric system with the unknowns and forces @p functional on them. The
    /// changes are added to @p report and @p load. Collective.
    void
    release(const std::vector<double> &functional,
            SceneLoad                 &load,
            SystemVector              &z,
            SolveReport               &report);

  private:
    struct Unknown
    {
      /// A solution for w, without other loads.
      SystemVector rhs, x;
      /// Of a motion: R, and A R at all nodes; else empty.
      PrescribedValues prescribed;
      Vector           at_nodes, borne;
      unsigned int     part = 0;
      Motion           direction{};
      /// Are R and w those of the present system, is there a solution, and is
      /// it of this system?
      bool has_lift = false, has_x = false, known = false;

      bool
      is_motion() const
      {
        return at_nodes.size() > 0;
      }
    };

    /// The sum of the sizes of the terms of w^T x. Collective.
    double
    size_of_product(unsigned int j, const SystemVector &x) const;
    /// w^T x.
    double
    product(unsigned int j, const SystemVector &x) const;
    /// w of a motion with the present system.
    void
    set_product(Unknown &unknown) const;
    /// R of a motion where the part is. Collective.
    void
    set_displacements(Unknown &unknown) const;
    /// R and w of a motion, where the part is, with the present system.
    void
    set_lift(Unknown &unknown) const;
    /// The displacements of @p part. Collective.
    Unknown
    lift(unsigned int part, const AffineField &field) const;
    /// Without what equilibrium decides.
    void
    set_motions();
    /// Work of @p forces on the motions, by unknown.
    std::vector<double>
    work_of(const Vector &forces) const;
    /// The change of the work of the nodal forces @p total and of loads on part
    /// @p p with its motion. Collective.
    void
    add_stiffness_of_forces(unsigned int p, const Vector &total);
    /// Entry of c, without the stiffness of forces.
    double
    stiffness_of(unsigned int i, unsigned int j) const;
    /// Unknowns of the motions that are free. Collective.
    void
    add_motions();
    /// F of the motions. Collective.
    void
    set_loads_of_motions(const SceneLoad &load);
    /// The solutions for all w; their reports are added to @p report.
    void
    solve_units(SolveReport &report);
    /// Solve for @p load without the unknowns, which start from earlier steps,
    /// then add the contribution of the unknowns.
    SolveReport
    solve_other_loads(const SceneLoad &load, SystemVector &x);
    /// Go on from @p x to the solution for @p rhs, of which @p report tells then,
    /// too.
    void
    solve_again(SystemVector &rhs, SystemVector &x, SolveReport &report);
    /// The d of the part d w of the constraint residual @p opening. Collective.
    double
    part_of_opening(unsigned int j, const Vector &opening) const;
    /// Add d w and d R to @p load.
    void
    add_to_load(const Unknown &unknown, double d, SceneLoad &load) const;
    /// The same for unknown @p j, whose solution joins @p x.
    void
    change(unsigned int j, double d, SceneLoad &load, SystemVector *x);
    /// Are forces given, and not all unknowns kept?
    bool
    has_force() const;
    /// Missing forces; zero if the shortening is kept.
    dealii::Vector<double>
    missing(const SystemVector &x) const;
    /// The largest of @p lacks relative to the forces there are with @p x.
    double
    relative(const dealii::Vector<double> &lacks, const SystemVector &x) const;

    /// Changes of unknowns for the missing forces @p lacks of a solution for @p rhs.
    /// After solve_units().
    dealii::Vector<double>
    changes_for(const dealii::Vector<double> &lacks,
                const SystemVector           &rhs) const;

    /// Of a unit of the mean stress on the unit strain @p k of the cell.
    double
    work_of_stress(unsigned int k) const;
    /// That of which forces of @p x lack a part, but for motions: the largest given
    /// one, or where all are zero those of the other loads and unknowns.
    /// Collective.
    double
    size_of_forces(const SystemVector &x) const;
    /// Throws InputError where mean strains that are free meet no resistance.
    void
    check_resistance(const dealii::FullMatrix<double> &stiffness) const;
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

    const RunContext         &run;
    const Discretisation     &discretisation;
    LinearSolver             &solver;
    std::vector<unsigned int> indices; ///< of shortenings, the first ones
    /// Behind these and the components of the mean strain.
    unsigned int           first_motion = 0;
    double                 volume       = 0.; ///< of the cell, if any
    std::vector<RigidPart> parts;
    std::vector<Motion>    at; ///< by part: its motion
    /// Of parts that turn far, by part: displacements by the entries of an
    /// AffineField.
    std::vector<std::vector<Unknown>> basis;
    Unknown                           others; ///< displacements of the load
    /// In Newton's method, by unknown: R^T f that is left at the iterate, and
    /// the size of what it is made of; its change with the motions for the same
    /// nodal forces f.
    std::vector<double>                begin_values, lacks, sizes;
    dealii::FullMatrix<double>         stiffness_of_forces;
    bool                               have_motions = false;
    std::vector<double>                values;
    std::vector<std::optional<double>> forces; ///< absent: kept shortening
    std::vector<Unknown>               all;
    /// Of a cell that is filled with incompressible bodies, the pressure of one
    /// and its multipliers, and by unknown what flows out with it, a volume;
    /// else absent and zero.
    std::optional<SystemVector>      enclosure;
    dealii::Vector<double>           fluxes;
    std::optional<std::vector<bool>> active; ///< set of the solutions
  };
} // namespace mortise
