// See contact_step.h.
#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/problem/contact_step.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int max_sets = 100;

    /// Of solves on the way to the set: doc/contact.md.
    constexpr double loose = 1e-2;

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

    ContactEdge
    make_edge(const Discretisation &discretisation, const MPI_Comm comm)
    {
      std::vector<Point<dim>>   places;
      std::vector<unsigned int> surfaces; // 0: no contact
      const auto               &all = discretisation.interfaces().all();
      for (unsigned int i = 0; i < all.size(); ++i)
        {
          const auto &pressing = discretisation.pressing()[i];
          for (unsigned int k = 0; k < all[i].multipliers->n_owned(); ++k)
            {
              surfaces.push_back(pressing.empty() ? 0 : 1 + i);
              places.push_back(pressing.empty() ? Point<dim>() :
                                                  pressing[k].place);
            }
        }
      return {std::move(places), std::move(surfaces), comm};
    }
  } // namespace

  ContactStep::ContactStep(const RunContext &run,
                           Discretisation   &discretisation,
                           LinearSolver     &solver)
    : run(run)
    , discretisation(discretisation)
    , solver(solver)
    , set(discretisation.one_sided(),
          discretisation.gap_stiffness(),
          first_multiplier(discretisation.linear_system()),
          run.comm)
    , edge(make_edge(discretisation, run.comm))
  {}

  bool
  ContactStep::differs_from_shown() const
  {
    return Utilities::MPI::max(shown == set.active() ? 0 : 1, run.comm) == 1;
  }

  std::string
  ContactStep::free_motions(const std::vector<bool> &active) const
  {
    try
      {
        discretisation.interfaces().check_held(active);
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "";
  }

  void
  ContactStep::start(const SceneLoad &load, const SystemVector &last)
  {
    const std::vector<bool> contact = discretisation.one_sided();
    std::vector<bool>       all(contact.size(), true), pressing(all);
    const bool              is_first = last.displacement.size() == 0;
    const SystemVector     &x =
      is_first ? discretisation.linear_system().zero_vector() : last;
    const Vector gaps = discretisation.gaps(load, x);
    double       area = 0.;
    for (const auto &multipliers : discretisation.pressing())
      for (const NormalMultiplier &multiplier : multipliers)
        area += multiplier.area;
    // what rounding leaves between meshes that touch is closed
    const double closed =
      1e-10 * std::sqrt(Utilities::MPI::sum(area, run.comm));
    for (unsigned int i = 0; i < contact.size(); ++i)
      pressing[i] = !contact[i] || (is_first ? gaps.begin()[i] <= closed :
                                               x.multiplier.begin()[i] > 0.);
    set.start_from(free_motions(pressing).empty() ? pressing : all);
  }

  SolveReport
  ContactStep::solve_set(const SceneLoad &load,
                         const double     tolerance,
                         SystemVector    &x)
  {
    discretisation.select(set.active());
    const unsigned int most    = run.parameters.solver.max_iterations;
    const bool         is_last = tolerance == run.parameters.solver.tolerance;
    // preconditioners go on with the ties that they saw until it pays that they
    // see those of now; smoothers know too little of many new ones
    const bool shows = !is_shown || (is_last && differs_from_shown()) ||
                       set.n_active() > 2 * n_shown;
    if (shows)
      show();
    else
      solver.update_active();
    const auto run_from = [&](const SystemVector &start,
                              const unsigned int  max_iterations) {
      solver.set_limits(tolerance, max_iterations);
      if (start.multiplier.size() > 0)
        solver.remember(load.rhs, start);
      return solver.solve(load.rhs, x);
    };
    if (x.multiplier.size() > 0)
      discretisation.linear_system().clear_inactive(x.multiplier.begin());
    const SystemVector start = x;
    const SolveReport  first =
      run_from(start, shows ? most : std::min(most, few_iterations));
    if (first.converged || shows)
      return first;
    show();
    SolveReport report = run_from(start, most);
    report.iterations += first.iterations;
    report.setup_seconds += first.setup_seconds;
    report.solve_seconds += first.solve_seconds;
    return report;
  }

  void
  ContactStep::show()
  {
    shown    = set.active();
    n_shown  = set.n_active();
    is_shown = true;
    discretisation.show_active();
    solver.update();
  }

  void
  ContactStep::print(const std::uint64_t      n_active,
                     const ActiveSet::Change &change,
                     const unsigned int       n_iterations) const
  {
    run.log.line("  active set " + std::to_string(sets) + ": " +
                 std::to_string(n_active) + " press, " +
                 std::to_string(change.opened) + " open, " +
                 std::to_string(change.closed) + " close, " +
                 std::to_string(change.undecided) + " undecided, " +
                 std::to_string(n_iterations) + " iterations" +
                 (set.cycles() ? ", one by one since sets came back" : ""));
  }

  ContactStep::Next
  ContactStep::advance(const SceneLoad    &load,
                       const SystemVector &x,
                       const double        tolerance,
                       const bool          extends)
  {
    const Vector gaps = discretisation.gaps(load, x);
    Next         next{set, {}, ""};
    next.change =
      next.set.advance(x.multiplier.begin(),
                       gaps.begin(),
                       std::max(gaps.linfty_norm(),
                                x.displacement.linfty_norm()),
                       // what a linear solve leaves is no reason to turn
                       std::max(least_accuracy, tolerance),
                       [&](std::vector<bool> &turns) {
                         if (extends)
                           edge.extend(set.active(), turns);
                       });
    unclear = next.set.undecided();
    if (next.change.any())
      next.free = free_motions(next.set.active());
    return next;
  }

  SolveReport
  ContactStep::solve(const SceneLoad    &load,
                     const SystemVector &last,
                     SystemVector       &x)
  {
    const double asked = run.parameters.solver.tolerance;
    // a factorisation gives all digits at once
    double tolerance = discretisation.choice().method == SolverMethod::direct ?
                         asked :
                         std::max(loose, asked);
    start(load, last);
    SolveReport  report;
    double       setup_seconds = 0., solve_seconds = 0.;
    bool         extends = true, extended = false;
    unsigned int overshoots = 0;
    iterations              = 0;
    sets                    = 1;
    while (true)
      {
        report = solve_set(load, tolerance, x);
        setup_seconds += report.setup_seconds;
        solve_seconds += report.solve_seconds;
        iterations += report.iterations;
        report.converged = report.converged && sets <= max_sets;
        if (!report.converged)
          break;
        Next next = advance(load, x, tolerance, extends && tolerance > asked);
        print(set.n_active(), next.change, report.iterations);
        // sets that close again may have opened beyond the edge
        if (extends && extended && next.change.closed > 0)
          ++overshoots;
        extended = extended || next.change.opened > 0;
        extends  = overshoots < max_overshoots &&
                  !(extended && next.change.closed > 0) && !next.set.cycles();
        if (tolerance == asked && !next.change.any())
          break;
        if (tolerance == asked && !next.free.empty())
          throw InputError("Contact is lost: where it pulls it opens, and what "
                           "still presses holds no longer. " +
                           next.free);
        if (tolerance > asked &&
            (!next.change.any() || !next.free.empty() || next.set.cycles()))
          {
            // and ask again; what is open until the end costs more there
            tolerance = next.change.undecided > 0 ?
                          std::max(asked, finer * tolerance) :
                          asked;
            set.start_from(set.active());
            continue;
          }
        set = std::move(next.set);
        ++sets;
      }
    report.setup_seconds = setup_seconds;
    report.solve_seconds = solve_seconds;
    return report;
  }
} // namespace mortise
