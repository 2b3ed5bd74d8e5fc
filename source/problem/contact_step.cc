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
    constexpr double loose = 1e-3;

    types::global_dof_index
    first_multiplier(const BlockSystem &system)
    {
      const auto &owned = system.owned_multiplier;
      return owned.n_elements() > 0 ? owned.nth_index_in_set(0) : 0;
    }
  } // namespace

  ContactStep::ContactStep(const RunContext &run,
                           Discretisation   &discretisation,
                           LinearSolver     &solver)
    : run(run)
    , discretisation(discretisation)
    , solver(solver)
    , set(discretisation.one_sided(),
          first_multiplier(discretisation.linear_system()),
          run.comm)
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
    // coarse levels go on with the ties that they saw until it pays that they
    // see those of now
    const bool is_last = tolerance == run.parameters.solver.tolerance;
    if (!is_shown || (is_last && differs_from_shown()))
      {
        shown    = set.active();
        is_shown = true;
        discretisation.show_active();
        solver.update();
      }
    else
      solver.update_active();
    solver.set_tolerance(tolerance);
    if (x.multiplier.size() > 0)
      {
        discretisation.linear_system().clear_inactive(x.multiplier.begin());
        solver.remember(load.rhs, x);
      }
    return solver.solve(load.rhs, x);
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
    SolveReport report;
    double      setup_seconds = 0., solve_seconds = 0.;
    iterations = 0;
    sets       = 1;
    while (true)
      {
        report = solve_set(load, tolerance, x);
        setup_seconds += report.setup_seconds;
        solve_seconds += report.solve_seconds;
        iterations += report.iterations;
        report.converged = report.converged && sets <= max_sets;
        if (!report.converged)
          break;
        const Vector gaps = discretisation.gaps(load, x);
        const double length =
          std::max(gaps.linfty_norm(), x.displacement.linfty_norm());
        // what a linear solve leaves is no reason to open or close
        const double            accuracy = std::max(1e-10, 10. * tolerance);
        ActiveSet               next     = set;
        const ActiveSet::Change change =
          next.advance(x.multiplier.begin(), gaps.begin(), length, accuracy);
        print(set.n_active(), change, report.iterations);
        const std::string free =
          change.any() ? free_motions(next.active()) : "";
        if (tolerance == asked)
          {
            if (!change.any())
              break;
            if (!free.empty())
              throw InputError("Contact is lost: where it pulls it opens, and "
                               "what still presses holds no longer. " +
                               free);
          }
        else if (!change.any() || !free.empty())
          {
            tolerance = asked; // and ask again
            set.start_from(set.active());
            continue;
          }
        set = std::move(next);
        ++sets;
      }
    report.setup_seconds = setup_seconds;
    report.solve_seconds = solve_seconds;
    return report;
  }
} // namespace mortise
