// See contact_step.h.
#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/problem/contact/contact_step.h>
#include <mortise/problem/contact/rigid_closing.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int max_sets = 1000;

    /// Of solves on the way to the set: doc/measurements/contact.md.
    constexpr double loose = 1e-2;

    /// The root of the energy of the error beside that of the solution, as a
    /// multiple of the tolerance: where the first set may be the last one, and
    /// on the way from a first set that is far from it.
    constexpr double loose_energy = 0.1, loosest_energy = 3.;

    /// As many as fields of load with factors of their own.
    constexpr unsigned int max_increments = 4;

    /// Then the edge is where extending does not find it.
    constexpr unsigned int max_overshoots = 3;

    /// Signs are not known any better.
    constexpr double least_accuracy = 1e-10;

    /// Of it, from one to the next where signs are not known yet.
    constexpr double finer = 1e-2;

    /// More of them tell of a preconditioner that has seen too little.
    constexpr unsigned int few_iterations = 40;

    types::global_dof_index
    first_multiplier(const BlockSystem &system)
    {
      const auto &owned = system.owned_multiplier;
      return owned.n_elements() > 0 ? owned.nth_index_in_set(0) : 0;
    }

    MultiplierPositions
    multiplier_positions(const Discretisation &discretisation)
    {
      MultiplierPositions positions;
      const auto         &all = discretisation.interfaces().all();
      for (unsigned int i = 0; i < all.size(); ++i)
        {
          for (const NormalMultiplier &multiplier : all[i].normal_multipliers)
            {
              positions.surfaces.push_back(1 + i);
              positions.points.push_back(multiplier.position);
            }
          positions.surfaces.resize(all[i].multipliers->range().end(), 0);
          positions.points.resize(positions.surfaces.size());
        }
      return positions;
    }

    /// By owned multiplier: NormalMultiplier::complementarity, or zero.
    std::vector<double>
    complementarity_parameters(const Discretisation &discretisation)
    {
      std::vector<double> result;
      for (const Coupling &coupling : discretisation.interfaces().all())
        {
          for (const NormalMultiplier &multiplier : coupling.normal_multipliers)
            result.push_back(multiplier.complementarity);
          result.resize(coupling.multipliers->range().end(), 0.);
        }
      return result;
    }
  } // namespace

  ContactStep::ContactStep(const RunContext              &run,
                           Discretisation                &discretisation,
                           LinearSolver                  &solver,
                           Preloads                      &preloads,
                           std::optional<ActivePositions> start)
    : run(run)
    , discretisation(discretisation)
    , solver(solver)
    , preloads(preloads)
    , set(discretisation.one_sided(),
          complementarity_parameters(discretisation),
          first_multiplier(discretisation.linear_system()),
          run.comm)
    , positions(multiplier_positions(discretisation))
    , edge(positions, run.comm)
    , first(std::move(start))
    , increments(max_increments)
    , undecided_multipliers(discretisation.one_sided().size(), false)
  {
    const std::vector<bool> contact = discretisation.one_sided();
    n_contact                       = Utilities::MPI::sum<std::uint64_t>(
      std::count(contact.begin(), contact.end(), true), run.comm);
  }

  ActivePositions
  ContactStep::active_positions() const
  {
    return {positions, set.active(), run.comm};
  }

  std::string
  ContactStep::free_motions(const std::vector<bool> &active) const
  {
    try
      {
        discretisation.interfaces().check_no_free_motion(
          active, preloads.have_forces());
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "";
  }

  void
  ContactStep::remember(Solved now)
  {
    if (!run.parameters.steps.given())
      return;
    if (!scaled)
      scaled = std::make_unique<ScaledResidual>(discretisation.linear_system());
    SystemVector rhs = now.rhs, x = now.x;
    if (last)
      {
        const bool other_set =
          Utilities::MPI::max(now.active == last->active ? 0 : 1, run.comm) ==
          1;
        // from one set to another an increment is half of each
        if (other_set || mixed_increment)
          increments = SuccessiveSolutions(max_increments);
        mixed_increment = other_set;
        add_scaled(rhs, -1., last->rhs);
        add_scaled(x, -1., last->x);
      }
    increments.add(rhs, x, *scaled);
    last = std::move(now);
  }

  void
  ContactStep::resume(const SceneLoad &load, const SystemVector &x)
  {
    remember({load.rhs, x, first->nearest(positions)});
  }

  std::vector<bool>
  ContactStep::predict(const SceneLoad &load, SystemVector &x)
  {
    const std::vector<bool> contact = discretisation.one_sided();
    const std::vector<bool> all(contact.size(), true);
    std::vector<bool>       guess = all;
    if (last)
      {
        x                = last->x;
        SystemVector rhs = load.rhs;
        add_scaled(rhs, -1., last->rhs);
        if (!increments.empty())
          add_scaled(x, 1., increments.start(rhs, *scaled));
      }
    double area = 0.;
    for (const Coupling &coupling : discretisation.interfaces().all())
      for (const NormalMultiplier &multiplier : coupling.normal_multipliers)
        area += multiplier.area;
    // what rounding leaves between meshes that touch is closed
    const double closed =
      1e-10 * std::sqrt(Utilities::MPI::sum(area, run.comm));
    const Vector gaps = discretisation.gaps(
      load, last ? x : discretisation.linear_system().zero_vector());
    if (!last && first)
      guess = first->nearest(positions);
    else
      for (unsigned int i = 0; i < contact.size(); ++i)
        guess[i] =
          !contact[i] || (last && last->active[i] ?
                            x.multiplier.begin()[i] > 0. :
                            gaps.begin()[i] <= (last ? -closed : closed));
    const auto holds = [this](const std::vector<bool> &active) {
      return free_motions(active).empty();
    };
    return holds(guess)                ? guess :
           last && holds(last->active) ? last->active :
                                         all;
  }

  double
  ContactStep::residual(const SystemVector &x)
  {
    if (sets == 0)
      {
        sets = 1; // the one that predict() chose
        return 1.;
      }
    const double            asked   = run.parameters.solver.tolerance;
    const bool              is_last = tolerance == asked;
    const Vector            gaps    = discretisation.gaps(*load, x);
    ActiveSet               next    = set;
    const ActiveSet::Change change =
      next.advance(x.multiplier.begin(),
                   gaps.begin(),
                   std::max(gaps.linfty_norm(), x.displacement.linfty_norm()),
                   // what a linear solve leaves is no reason to turn
                   std::max(least_accuracy, tolerance),
                   [&](std::vector<bool> &turns) {
                     if (extends && !is_last)
                       edge.extend(set.active(), turns);
                   });
    undecided_multipliers = next.undecided();
    print(change);
    // sets that close again may have opened beyond the edge
    if (extends && extended && change.closed > 0)
      ++overshoots;
    extended = extended || change.opened > 0;
    extends  = cold && overshoots < max_overshoots &&
              !(extended && change.closed > 0) && !next.cycles();
    if (is_last && !change.any())
      return 0.;
    if (is_last)
      catch_bodies(x, next);
    else if (!change.any() || next.cycles() ||
             !free_motions(next.active()).empty())
      {
        // and ask again; what is open until the end costs more there
        tolerance =
          change.undecided > 0 ? std::max(asked, finer * tolerance) : asked;
        set.start_from(set.active());
        return tolerance;
      }
    set = std::move(next);
    ++sets;
    return double(change.opened + change.closed) / n_contact;
  }

  void
  ContactStep::catch_bodies(const SystemVector &x, ActiveSet &next) const
  {
    if (free_motions(next.active()).empty())
      return;
    next.start_from(
      close_gaps_rigidly(discretisation, preloads, *load, x, next.active()));
    if (const std::string free = free_motions(next.active()); !free.empty())
      throw InputError(
        "Contact is lost: the contact that remains active does not hold the bodies. " +
        free);
  }

  void
  ContactStep::linearise(const SystemVector &)
  {
    discretisation.select(set.active());
    // coarse levels go on with the ties that they saw, which costs next to no
    // iteration (doc/measurements/contact.md) as long as about as many hold
    const std::uint64_t n_active = set.n_active();
    shows =
      !n_shown || n_active > 2 * *n_shown ||
      (tolerance == run.parameters.solver.tolerance && 2 * n_active < *n_shown);
    if (shows)
      show();
    else
      solver.update_active();
  }

  SolveReport
  ContactStep::solve(SystemVector &x)
  {
    const unsigned int most = run.parameters.solver.max_iterations;
    if (x.displacement.size() > 0)
      discretisation.linear_system().clear_inactive(x.multiplier);
    const SystemVector start = shows ? SystemVector() : x;
    SolveReport        result =
      solve_set(shows ? most : std::min(most, few_iterations), x);
    if (!shows && !result.converged)
      {
        const SolveReport tried = result;
        show();
        x      = start;
        result = solve_set(most, x);
        result.iterations += tried.iterations;
        result.setup_seconds += tried.setup_seconds;
        result.solve_seconds += tried.solve_seconds;
      }
    iterations = result.iterations;
    return result;
  }

  SolveReport
  ContactStep::solve_set(const unsigned int max_iterations, SystemVector &x)
  {
    solver.set_limits(tolerance,
                      tolerance == run.parameters.solver.tolerance ?
                        SolverOptions().energy_fraction :
                      cold && sets > 1 ? loosest_energy :
                                         loose_energy,
                      max_iterations);
    return preloads.solve(x.displacement.size() > 0, *load, x);
  }

  void
  ContactStep::show()
  {
    n_shown = set.n_active();
    discretisation.update_coarse_active_set();
    solver.update();
  }

  void
  ContactStep::print(const ActiveSet::Change &change) const
  {
    run.log.line(
      "  active set " + std::to_string(sets) + ": " +
      std::to_string(set.n_active()) + " active, " +
      std::to_string(change.opened) + " open, " +
      std::to_string(change.closed) + " close, " +
      std::to_string(change.undecided) + " undecided, " +
      std::to_string(iterations) + " iterations" +
      (set.cycles() ? ", chosen by the energy, since sets recurred" : ""));
  }

  SolveReport
  ContactStep::solve(SceneLoad &of_step, SystemVector &x)
  {
    const double asked = run.parameters.solver.tolerance;
    load               = &of_step;
    // a factorisation gives all digits at once
    tolerance = discretisation.choice().method == SolverMethod::direct ?
                  asked :
                  std::max(loose, asked);
    // from lower degrees and from step to step the edge is near already
    cold       = !first && !last;
    extends    = cold;
    extended   = false;
    overshoots = 0;
    sets       = 0;
    set.start_from(predict(of_step, x));
    NewtonOptions options;
    options.tolerance      = 0.;
    options.max_iterations = max_sets;
    options.max_halvings   = 0;
    report                 = solve_newton(*this, options, x);
    if (report.converged)
      remember({of_step.rhs, x, set.active()});
    SolveReport result = report.linear;
    result.converged   = report.converged;
    return result;
  }
} // namespace mortise
