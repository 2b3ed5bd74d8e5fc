// See contact_step.h.
#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/problem/contact/contact_step.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int max_sets = 1000, max_sets_of_friction = 60;

    /// For one pairing: tangents need not be positive there, and then no set
    /// need be that of a solution.
    constexpr unsigned int max_following_sets = 30;

    /// Of solves on the way to the set: doc/measurements/contact.md.
    constexpr double loose = 1e-2;

    /// As many as fields of load with factors of their own.
    constexpr unsigned int max_increments = 4;

    /// Then the edge is where extending does not find it.
    constexpr unsigned int max_overshoots = 3;

    /// Of residuals, by linear solves with friction. The first tells all nodes
    /// that slip; later ones are as exact as few nodes turn, down to a least
    /// reduction; those of a set that stays follow the violation.
    constexpr double first_reduction = 1e-3, coarse_reduction = 0.1,
                     finest_of_sets = 1e-3, fine_reduction = 1e-4;

    /// Of it, from one to the next where signs are not known yet.
    constexpr double finer = 1e-2;

    std::vector<double>
    complementarity_parameters(const Discretisation &discretisation)
    {
      std::vector<double> result;
      for (const ContactNode *node :
           discretisation.interfaces().contact_nodes())
        result.push_back(node->complementarity);
      return result;
    }

    NodePositions
    node_positions(const Discretisation &discretisation)
    {
      NodePositions positions;
      for (const Coupling &coupling : discretisation.interfaces().all())
        for (const ContactNode &node : coupling.contact_nodes)
          {
            positions.surfaces.push_back(1 + coupling.number);
            positions.points.push_back(node.position);
          }
      return positions;
    }
  } // namespace

  ContactStep::ContactStep(const RunContext                    &run,
                           Discretisation                      &discretisation,
                           LinearSolver                        &solver,
                           GlobalUnknowns                      &unknowns,
                           const std::optional<ContactRecords> &known)
    : run(run)
    , discretisation(discretisation)
    , solver(solver)
    , unknowns(unknowns)
    , set(complementarity_parameters(discretisation),
          !discretisation.interfaces().have_friction(),
          run.comm)
    , friction(run, discretisation)
    , positions(node_positions(discretisation))
    , edge(positions, run.comm)
    , n_contact(
        Utilities::MPI::sum<std::uint64_t>(positions.points.size(), run.comm))
    , increments(max_increments)
  {
    if (known)
      {
        first = known->nearest(positions);
        std::vector<bool> closed;
        for (const ContactRecord &record : *first)
          closed.push_back(record.closed);
        set.start_from(closed);
      }
    if (!friction.empty())
      report_held();
  }

  double
  ContactStep::residual(const SystemVector &x)
  {
    if (sets == 0)
      {
        sets = 1; // the one that predict() chose
        return 1.;
      }
    const bool is_last = tolerance == asked;
    // what a linear solve leaves is no reason to turn
    const double            accuracy = std::max(least_accuracy, tolerance);
    const Vector            weighted = discretisation.weighted_gaps(*load, x);
    ActiveSet               next     = set;
    const ActiveSet::Change change =
      next.advance(pressures(x),
                   discretisation.gaps(weighted),
                   x.displacement.linfty_norm(),
                   accuracy,
                   [&](std::vector<bool> &turns) {
                     if (extends && !is_last)
                       edge.extend(set.active(), turns);
                   });
    const std::vector<Friction> before = friction.laws();
    FrictionSet::Change         of_friction =
      friction.empty() ?
                FrictionSet::Change() :
                friction.advance(next.active(),
                         x.multiplier,
                         weighted,
                         std::max(least_accuracy, loose * tolerance));
    if (!friction.empty() && !is_last)
      extend_slip(next.active(), before, x, weighted, of_friction);
    print(change, before, of_friction);
    learn_extension(change, next.cycles());
    const bool changes = change.any() || of_friction.any();
    // a linear system of these laws that is solved already shows that they hold
    const bool is_solved =
      iterations == 0 && discretisation.choice().method != SolverMethod::direct;
    if (is_last && !changes &&
        (of_friction.error <= std::max(10. * accuracy, allowed_violation) ||
         is_solved))
      {
        set      = std::move(next);
        is_loose = !is_solved && of_friction.error > 10. * accuracy;
        return 0.;
      }
    if (const double before_that = std::exchange(violation, of_friction.error);
        discretisation.interfaces().follow() && sets >= max_following_sets &&
        violation <= before_that)
      {
        if (!friction.empty())
          friction.take(before);
        no_set = true;
        return 0.;
      }
    if (!friction.empty())
      check_hold(next.active());
    const auto free = [&] {
      return !free_motions(friction.laws_without_resistance(next.active()))
                .empty();
    };
    if (is_last)
      {
        if (!friction.empty())
          hold_bodies(next.active(), before);
        catch_bodies(x, next);
      }
    else if (!changes || next.cycles() || free())
      {
        // and ask again; what is open until the end costs more there
        tolerance =
          change.undecided > 0 ? std::max(asked, finer * tolerance) : asked;
        reduction =
          changes || of_friction.error <= fine_reduction ? 0. : fine_reduction;
        if (changes)
          friction.take(before);
        set.start_from(set.active());
        return tolerance;
      }
    const double turning = double(change.opened + change.closed +
                                  of_friction.slip + of_friction.stick) /
                           n_contact;
    reduction = changes ? std::max(finest_of_sets, coarse_reduction * turning) :
                          std::min(coarse_reduction,
                                   std::max(fine_reduction, of_friction.error));
    set       = std::move(next);
    ++sets;
    return turning + of_friction.error;
  }

  void
  ContactStep::extend_slip(const std::vector<bool>     &next,
                           const std::vector<Friction> &before,
                           const SystemVector          &x,
                           const Vector                &weighted_gaps,
                           FrictionSet::Change         &change)
  {
    // what sticks again slipped beyond the edge
    slip_extends = slip_extends && !(slip_extended && change.stick > 0);
    if (!slip_extends || change.slip == 0)
      return;
    const std::vector<Friction> laws = friction.laws();
    const std::uint64_t         more =
      friction.extend(positions, next, before, x.multiplier, weighted_gaps);
    if (!free_motions(friction.laws_without_resistance(next)).empty())
      friction.take(laws);
    else
      {
        change.slip += more;
        slip_extended = slip_extended || more > 0;
      }
  }

  void
  ContactStep::learn_extension(const ActiveSet::Change &change,
                               const bool               cycles)
  {
    // sets that close again may have opened beyond the edge
    if (extends && extended && change.closed > 0)
      ++overshoots;
    extended = extended || change.opened > 0;
    extends  = cold && overshoots < max_overshoots &&
              !(extended && change.closed > 0) && !cycles;
  }

  void
  ContactStep::print(const ActiveSet::Change     &change,
                     const std::vector<Friction> &before,
                     const FrictionSet::Change   &of_friction) const
  {
    std::string slips, changes;
    if (!friction.empty())
      {
        std::uint64_t n_slip = 0;
        for (unsigned int i = 0; i < before.size(); ++i)
          n_slip +=
            set.active()[i] && before[i].status == NodeStatus::slip ? 1 : 0;
        slips =
          std::to_string(Utilities::MPI::sum(n_slip, run.comm)) + " slip, ";
        changes = std::to_string(of_friction.slip) + " begin to slip, " +
                  std::to_string(of_friction.stick) + " to stick, violation " +
                  RunLog::number(of_friction.error) + ", ";
      }
    run.log.line(
      "  active set " + std::to_string(sets) + ": " +
      std::to_string(set.n_active()) + " active, " + slips +
      std::to_string(change.opened) + " open, " +
      std::to_string(change.closed) + " close, " +
      std::to_string(change.undecided) + " undecided, " + changes +
      std::to_string(iterations) + " iterations" +
      (set.cycles() ? ", chosen by the energy, since sets recurred" : ""));
  }

  SolveReport
  ContactStep::solve(const SceneData &data,
                     SceneLoad       &of_step,
                     SystemVector    &x,
                     const double     accuracy,
                     const double     part,
                     const double     violation_allowed)
  {
    asked             = accuracy;
    allowed_violation = violation_allowed;
    load              = &of_step;
    friction.begin(data);
    // a factorisation gives all digits at once, and with other pairs within a
    // step the set is near
    tolerance =
      other_pairs || discretisation.choice().method == SolverMethod::direct ?
        asked :
        std::max(loose * part, asked);
    used_strength.reset();
    // from lower degrees and from step to step the edge is near already
    cold          = !first && !last;
    extends       = cold;
    extended      = false;
    overshoots    = 0;
    slip_extends  = true;
    slip_extended = false;
    no_set = is_loose = false;
    sets              = 0;
    set.start_from(predict(of_step, x));
    // where nothing is predicted to turn one system is all
    const bool turns =
      !last ||
      Utilities::MPI::max(statuses() == last->statuses ? 0 : 1, run.comm) == 1;
    reduction = tolerance == asked || !turns ? 0. : first_reduction;
    NewtonOptions options;
    options.tolerance      = 0.;
    options.max_iterations = friction.empty() ? max_sets : max_sets_of_friction;
    options.max_halvings   = 0;
    report                 = solve_newton(*this, options, x);
    if (report.converged)
      remember({of_step.rhs, x, statuses()});
    else if (!lost.empty())
      throw InputError(lost);
    SolveReport result = report.linear;
    result.converged   = report.converged;
    return result;
  }
} // namespace mortise
