// The linear solves of a ContactStep.
#include <deal.II/base/mpi.h>

#include <mortise/problem/contact/contact_step.h>

#include <algorithm>
#include <utility>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// The root of the energy of the error beside that of the solution, as a
    /// multiple of the tolerance: where the first set may be the last one, and
    /// on the way from a first set that is far from it.
    constexpr double loose_energy = 0.1, loosest_energy = 3.;

    /// More of them, and more than this times those with a preconditioner that
    /// has seen the set, tell of one that has seen too little.
    constexpr unsigned int few_iterations = 40, times_seen = 2;
  } // namespace

  void
  ContactStep::linearise(const SystemVector &)
  {
    const bool turns    = friction.select(set.active());
    const auto statuses = this->statuses();
    // coarse levels go on with the ties that they saw, which costs next to no
    // iteration (doc/measurements/contact.md) as long as about as many hold
    const std::uint64_t n_held = n_holding(statuses);
    shows                      = !n_shown || n_held > 2 * *n_shown ||
            (tolerance == asked && 2 * n_held < *n_shown);
    const bool repaired = std::exchange(other_pairs, false);
    const bool changes =
      Utilities::MPI::max(statuses == prepared ? 0 : 1, run.comm) == 1 ||
      !solver.is_ready();
    prepared = statuses;
    if (shows)
      show();
    else if (repaired)
      solver.update_interfaces();
    else if (turns)
      solver.update_directions();
    else if (changes)
      solver.update_active();
    if (turns)
      unknowns.system_changed();
  }

  SolveReport
  ContactStep::solve(SystemVector &x)
  {
    const unsigned int most  = run.parameters.solver.max_iterations;
    const SystemVector start = shows ? SystemVector() : x;
    SolveReport        result =
      solve_set(shows ? most :
                        std::min(most,
                                 std::max(few_iterations,
                                          times_seen * iterations_when_shown)),
                x);
    if (!shows && !result.converged)
      {
        const SolveReport tried = result;
        show();
        x      = start;
        result = solve_set(most, x);
        iterations_when_shown =
          std::max(iterations_when_shown, result.iterations);
        result.iterations += tried.iterations;
        result.add_seconds(tried);
      }
    iterations = result.iterations;
    return result;
  }

  SolveReport
  ContactStep::solve_set(const unsigned int max_iterations, SystemVector &x)
  {
    const bool exact = asked <= run.parameters.solver.tolerance;
    if (!friction.empty())
      {
        solver.set_limits(asked,
                          SolverOptions().energy_fraction,
                          max_iterations,
                          reduction);
        return solve_with_friction(x);
      }
    solver.set_limits(tolerance,
                      tolerance > asked || !exact ?
                        cold && sets > 1 ? loosest_energy : loose_energy :
                        SolverOptions().energy_fraction,
                      max_iterations);
    return unknowns.solve(x.displacement.size() > 0, *load, x);
  }

  SolveReport
  ContactStep::solve_with_friction(SystemVector &x)
  {
    SystemVector of_load = load->rhs;
    friction.apply(load->rhs);
    const Vector      applied = load->rhs.multiplier;
    const SolveReport result =
      unknowns.solve(x.displacement.size() > 0, *load, x);
    // global unknowns become part of the load
    load->rhs.multiplier -= applied;
    of_load.multiplier += load->rhs.multiplier;
    load->rhs = of_load;
    friction.complete(x.multiplier);
    tolerance = result.tolerance;
    return result;
  }

  void
  ContactStep::take_preconditioner(const ContactStep &other)
  {
    n_shown               = other.n_shown;
    iterations_when_shown = other.iterations_when_shown;
    other_pairs           = true;
  }

  std::uint64_t
  ContactStep::n_holding(const std::vector<NodeStatus> &statuses) const
  {
    std::uint64_t n = 0;
    for (const NodeStatus status : statuses)
      n += status == NodeStatus::stick ? 2 : status == NodeStatus::slip ? 1 : 0;
    return Utilities::MPI::sum(n, run.comm);
  }

  void
  ContactStep::show()
  {
    const std::vector<NodeStatus> statuses = this->statuses();
    n_shown                                = n_holding(statuses);
    discretisation.update_penalties(statuses);
    solver.update();
  }
} // namespace mortise
