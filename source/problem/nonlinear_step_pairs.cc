// Newton's method of a NonlinearStep where interfaces follow the bodies.
#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/problem/nonlinear_step.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int most_pairings = 60, few_useless = 5,
                           most_useless = 20, few_pairings = 10,
                           most_without_set = 2;

    /// Residuals below the smaller that do not fall or that linear solves leave
    /// as they are, and below the larger that do not fall by half in so many
    /// iterations, are what numbers of points of integration leave that change
    /// with the pairs.
    constexpr double       rounding_of_pairs = 1e-7, most_rounding = 1e-6;
    constexpr unsigned int most_of_rounding = 3;

    /// Of friction beside the largest traction, on the way.
    constexpr double loosest_violation = 1e-3;

    /// Of residuals from one iteration to the next.
    constexpr double slow_contraction = 0.1;

    /// Residuals that have risen so far beside all forces of the bodies: other
    /// iterations are tried at once.
    constexpr double hopeless = 1.;

    /// After so many steps in turn that were solved without the stiffness of
    /// contact forces the next one begins without it.
    constexpr unsigned int few_without_stiffness = 2;

    /// A step starts from an extrapolation that leaves less than this part of
    /// the residual of the last state.
    constexpr double ahead_residual = 0.5;

    bool
    are_equal(const Vector &a, const Vector &b, const MPI_Comm comm)
    {
      const bool same =
        a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin());
      return Utilities::MPI::min(same ? 1 : 0, comm) == 1;
    }
  } // namespace

  void
  NonlinearStep::pair_at(const Vector &displacement)
  {
    SystemVector x = discretisation.linear_system().zero_vector();
    x.displacement = displacement;
    SceneLoad without_prescribed;
    // both sides may have moved so far, towards each other
    double moved = 0.;
    if (begin.size() > 0)
      {
        Vector way(displacement);
        way -= begin;
        moved = 2. * std::sqrt(double(dim)) * way.linfty_norm();
      }
    discretisation.pair(discretisation.solutions(without_prescribed, x), moved);
    discretisation.set_gaps(*data, *load);
    unknowns.pair_again();
    unknowns.add_shortenings(*load);
    norm = std::make_unique<ScaledResidual>(discretisation.linear_system());
    paired_at = displacement;
  }

  void
  NonlinearStep::begin_contact(const std::optional<ContactRecords> &known)
  {
    auto next = std::make_unique<ContactStep>(
      run, discretisation, solver, unknowns, known);
    if (linearised_at)
      next->take_preconditioner(*contact);
    *of_scene = std::move(next);
    contact   = of_scene->get();
  }

  void
  NonlinearStep::go_on(const ContactRecords &known,
                       const State          &last,
                       const SlipOrigin     &origin,
                       const SystemVector   &x)
  {
    begin_contact(known);
    const bool has_last = last.displacement.size() > 0;
    contact->follow(has_last ? last.contact : std::nullopt,
                    origin,
                    *data,
                    *load,
                    free_part(x));
  }

  void
  NonlinearStep::begin_contact_of(const State        &last,
                                  const SlipOrigin   &origin,
                                  const SystemVector &x)
  {
    if (last.displacement.size() > 0 && last.contact)
      go_on(*last.contact, last, origin, x);
    else if (contact != nullptr)
      begin_contact(last.contact);
  }

  Iterate
  NonlinearStep::without_pairs(const SystemVector &x) const
  {
    Iterate result{x,
                   multipliers_by_face(discretisation.interfaces(),
                                       x.multiplier,
                                       run.comm)};
    result.x.multiplier.reinit(0);
    return result;
  }

  std::optional<ContactRecords>
  NonlinearStep::records(const SystemVector &x) const
  {
    std::optional<ContactRecords> result;
    if (contact != nullptr)
      result = contact->records_of_iterate(*load, free_part(x));
    return result;
  }

  void
  NonlinearStep::pair_again(const Iterate                       &given,
                            const std::optional<ContactRecords> &reached,
                            const State                         &last,
                            const SlipOrigin                    &origin,
                            SystemVector                        &x)
  {
    x = given.x;
    pair_at(x.displacement);
    x.multiplier.reinit(
      discretisation.linear_system().zero_vector().multiplier);
    set_multipliers(given.multipliers,
                    discretisation.interfaces(),
                    x.multiplier);
    if (reached)
      go_on(*reached, last, origin, x);
    else if (linearised_at)
      solver.update_interfaces();
  }

  void
  NonlinearStep::extrapolate_pairs(const State      &last,
                                   const SlipOrigin &origin,
                                   SystemVector     &x)
  {
    accepted.add(without_pairs(x));
    if (accepted.n_states() < 2 || (contact != nullptr && !last.contact))
      return;
    const Iterate ahead = accepted.at(data->at_time(), 2);
    if (rest_of_prescribed(ahead.x).l2_norm() >
        ahead_residual * rest_of_prescribed(x).l2_norm())
      return;
    const double       largest = ahead_residual * residual(x);
    const SystemVector start   = x;
    try
      {
        // statuses are those at the end of the last step
        pair_again(ahead, last.contact, last, origin, x);
        at_last_state = !(residual(x) < largest);
      }
    catch (const InputError &)
      {}
    if (!at_last_state)
      return;
    x = start;
    pair_at(x.displacement);
  }

  double
  NonlinearStep::allowed_violation() const
  {
    // other pairs violate the law again
    return follows() && contraction * size > most_rounding ? loosest_violation :
                                                             0.;
  }

  NewtonReport
  NonlinearStep::follow(const State &last, SystemVector &x)
  {
    const SystemVector start = x;
    has_force_stiffness      = n_without_stiffness < few_without_stiffness;
    NewtonReport report      = improve_with_pairs(last, true, x);
    const auto   again       = [&](const std::string &how) {
      run.log.line("    again " + how);
      x = start;
      unknowns.go_back(*load);
      begin_iterations();
      const NewtonReport tried = report;
      report                   = improve_with_pairs(last, false, x);
      report.linear_iterations += tried.linear_iterations;
      report.linear.add_seconds(tried.linear);
      report.easy = false;
    };
    if (!report.converged && !at_last_state)
      again("from the last state");
    if (!report.converged)
      {
        has_force_stiffness = !has_force_stiffness;
        again(has_force_stiffness ? "with the stiffness of contact forces" :
                                    "without the stiffness of contact forces");
      }
    n_without_stiffness =
      report.converged && !has_force_stiffness ? n_without_stiffness + 1 : 0;
    return report;
  }

  NewtonReport
  NonlinearStep::improve_with_pairs(const State  &last,
                                    const bool    extrapolates,
                                    SystemVector &x)
  {
    const auto zero = [this] {
      return discretisation.linear_system().zero_vector().multiplier;
    };
    begin = x.displacement;
    if (!are_equal(paired_at, x.displacement, run.comm))
      {
        pair_at(x.displacement);
        // those of the last state belong to this pairing
        if (x.multiplier.size() != zero().size())
          x.multiplier.reinit(zero());
      }
    const SlipOrigin origin(discretisation.interfaces().all(),
                            discretisation.linear_system().owned_displacement,
                            discretisation.displacement_of_pairing(),
                            run.comm);
    if (extrapolates)
      extrapolate_pairs(last, origin, x);
    if (at_last_state)
      begin_contact_of(last, origin, x);
    Acceleration acceleration(discretisation.linear_system().bulk->diagonal());
    double       best  = std::numeric_limits<double>::infinity();
    unsigned int rises = 0, n_without_set = 0;
    NewtonReport all;
    while (all.iterations < most_pairings &&
           rises < (has_force_stiffness ? few_useless : most_useless))
      {
        const Vector       given = x.displacement;
        const NewtonReport one   = improve(1, x);
        const bool lacks_set     = contact != nullptr && contact->lacks_set();
        all.linear_iterations += one.linear_iterations;
        const SolveReport before = all.linear;
        all.linear               = one.linear;
        all.linear.add_seconds(before);
        if (one.iterations == 0)
          {
            all.residual  = one.residual;
            all.converged = one.converged && n_without_set == 0;
            break;
          }
        Iterate    reached = without_pairs(x);
        const auto known   = records(x);
        acceleration.add(given, reached);
        if (contraction > slow_contraction)
          {
            Iterate accelerated = acceleration.next();
            set_prescribed(accelerated.x);
            accelerated.x.multiplier.reinit(x.multiplier);
            // where no cell inverts
            if (balance(accelerated.x))
              reached = std::move(accelerated);
          }
        try
          {
            pair_again(reached, known, last, origin, x);
          }
        catch (const InputError &error)
          {
            why      = error.what();
            is_wrong = true;
            x.multiplier.reinit(zero());
            all.residual = std::numeric_limits<double>::infinity();
            break;
          }
        const double before_that = all.residual;
        all.residual             = residual(x);
        if (all.iterations > 0)
          contraction = all.residual / before_that;
        print(++all.iterations, all.residual);
        const bool falls = all.residual < best;
        rises            = all.residual < 0.5 * best ? 0 : rises + 1;
        best             = std::min(best, all.residual);
        n_without_set    = lacks_set ? n_without_set + 1 : 0;
        all.converged    = !lacks_set && !violates &&
                        (all.residual <= tolerance() ||
                         (best < rounding_of_pairs && (!falls || stays)) ||
                         (best < most_rounding && rises >= most_of_rounding));
        if (all.converged || n_without_set > most_without_set ||
            (has_force_stiffness && rises > 0 && all.residual > hopeless))
          break;
      }
    all.easy = all.converged && all.iterations <= few_pairings;
    return all;
  }
} // namespace mortise
