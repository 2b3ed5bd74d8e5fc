// The linear solves of NonlinearStep.
#include <mortise/operators/cells/cell_histories.h>
#include <mortise/problem/nonlinear_step.h>

#include <algorithm>
#include <cmath>

namespace mortise
{
  namespace
  {
    /// Of the residual of a linear solve, see doc/measurements/nonlinear.md.
    constexpr double loosest_solve = 0.01;

    /// Of the first problem of contact that follows the bodies.
    constexpr double first_contact = 1e-3;

    /// Nodes begin to slip and to stick where the solution is less exact.
    constexpr double loosest_of_friction = 1e-3;

    /// Of one linear solve; what it has reached then may serve all the same,
    /// but on a path, where tangents are nearly singular beside a limit point.
    constexpr unsigned int most_linear_iterations = 100, most_on_path = 400;
    constexpr double       fair_solve = 0.5;

    /// Preconditioners are made again where this many times the fewest
    /// iterations per digit are needed.
    constexpr double largest_cost = 2.;
  } // namespace

  void
  NonlinearStep::linearise(const SystemVector &x)
  {
    const bool elastic = size_before == 0. && at_last_state;
    const bool refresh =
      !solver.is_ready() ||
      (follows() ? !linearised_at :
                   least_cost == 0. || last_cost > largest_cost * least_cost ||
                     (elastic && shows_flow));
    discretisation.linearise(
      x, linearised_at ? &*linearised_at : nullptr, before, *load, refresh);
    linearised_at = x;
    if (follows() && has_force_stiffness)
      discretisation.add_force_stiffness(x.multiplier);
    unknowns.system_changed();
    if (!refresh)
      return;
    shows_flow = !elastic && may_yield;
    // a new ContactStep makes preconditioners itself
    if (!follows() || contact == nullptr)
      {
        solver.update();
        if (!solver.is_ready())
          show_without_stress();
      }
    norm = std::make_unique<ScaledResidual>(discretisation.linear_system());
    least_cost = 0.;
  }

  void
  NonlinearStep::show_without_stress()
  {
    discretisation.show_tangent(false);
    solver.update();
  }

  void
  NonlinearStep::linearise_at(const State &state)
  {
    SystemVector x = state.solution;
    x.displacement = state.displacement;
    linearised_at.reset();
    has_force_stiffness = true;
    linearise(x);
    solver.set_limits(run.parameters.solver.tolerance,
                      SolverOptions().energy_fraction,
                      run.parameters.solver.max_iterations);
  }

  SolveReport
  NonlinearStep::solve(SystemVector &x)
  {
    return contact != nullptr ? solve_contact(x) : solve_linear(x);
  }

  SolveReport
  NonlinearStep::solve_contact(SystemVector &x)
  {
    // K (x' + D) = f - f_int + K u and so on for the solution x' without the
    // prescribed displacements D
    const BlockSystem &system   = discretisation.linear_system();
    SystemVector       products = system.zero_vector();
    Vector             moved(x.displacement);
    moved -= load->prescribed_at_nodes;
    if (system.mixed())
      system.bulk->apply_mixed(products.displacement,
                               products.pressure,
                               moved,
                               x.pressure);
    else
      system.bulk->apply_to_constrained(moved, products);
    if (x.multiplier.size() > 0)
      system.constraint.Tvmult_add(products.displacement, x.multiplier);
    SceneLoad linear        = *load;
    linear.rhs.displacement = r.displacement;
    linear.rhs.displacement += products.displacement;
    for (const unsigned int i : system.bulk->levels().front().constrained)
      linear.rhs.displacement.local_element(i) = 0.;
    if (system.mixed())
      {
        linear.rhs.pressure = r.pressure;
        linear.rhs.pressure += products.pressure;
      }
    SystemVector solution = free_part(x); // from the iterate
    if (unknowns.has_motions())
      {
        SystemVector without = system.zero_vector();
        without.displacement = solution.displacement;
        without.pressure     = x.pressure;
        unknowns.count_from(without);
      }
    const SystemVector start = solution;
    // of slender bodies stiffness times displacement is far more than forces
    const double part     = std::min(1., reference / norm->norm(linear.rhs));
    const double accuracy = accuracy_of_contact(part);
    SolveReport  report   = contact->solve(
      *data, linear, solution, accuracy, part, allowed_violation());
    const auto again = [&](const double tolerance) {
      solution = start;
      report   = contact->solve(*data, linear, solution, tolerance, part);
    };
    if (!solver.is_ready())
      {
        show_without_stress();
        again(accuracy);
      }
    if (!report.converged && discretisation.try_as_indefinite())
      again(accuracy);
    // sets may cycle where solutions are loose
    const double least = run.parameters.solver.tolerance;
    if (!report.converged && accuracy > least)
      again(least);
    x = solution;
    x.displacement += linear.prescribed_at_nodes;
    for (const unsigned int i : hanging)
      x.displacement.local_element(i) = 0.;
    // with the global unknowns
    load->rhs.multiplier      = linear.rhs.multiplier;
    load->prescribed          = linear.prescribed;
    load->prescribed_at_nodes = linear.prescribed_at_nodes;
    if (unknowns.has_motions())
      settle(x);
    last_iterations   = contact->linear_iterations();
    report.iterations = last_iterations; // of all sets
    stays             = report.converged && last_iterations == 0;
    violates          = contact->violates_friction();
    least_cost        = 0.; // preconditioners see each state
    if (!report.converged)
      why = "contact does not converge";
    return report;
  }

  double
  NonlinearStep::accuracy_of_contact(const double part) const
  {
    const double least = run.parameters.solver.tolerance;
    if (!follows())
      return least;
    // choice 2 of Eisenstat and Walker
    const double eta = contraction > 0. ?
                         std::min(discretisation.interfaces().have_friction() ?
                                    loosest_of_friction :
                                    loosest_solve,
                                  0.9 * contraction * contraction) :
                         first_contact;
    return std::max(least, eta * std::min(1., size) * part);
  }

  SolveReport
  NonlinearStep::solve_linear(SystemVector &x)
  {
    // choice 2 of Eisenstat and Walker
    const double ratio = size_before > 0. ? size / size_before : 1.;
    double       eta   = std::min(loosest_solve, 0.9 * ratio * ratio);
    eta = std::max(eta, 0.3 * run.parameters.solver.tolerance / size);
    eta = std::min(eta, loosest_solve);
    // what a loose solve leaves of a large motion would yield; and an elastic
    // step then takes one solve, as a linear one does
    if (size_before == 0. && may_yield)
      eta = run.parameters.solver.tolerance;
    size_before = size;

    const Vector rest = rest_of_prescribed(x);
    set_tolerance(eta);
    SystemVector dx;
    SolveReport  report = along != nullptr ? solve_bordered(x, rest, dx) :
                                             solve_tangent(lifted(r, rest), dx);
    if (along == nullptr)
      unknowns.complete_increment(x, rest, *load, dx, report);
    else if (report.converged)
      set_time(x.time + dx.time);
    add_scaled(x, 1., dx);
    set_prescribed(x);
    if (unknowns.has_motions())
      settle(x);
    last_iterations = report.iterations;
    if (!report.converged)
      why = "the linear solver does not converge";
    return report;
  }

  void
  NonlinearStep::set_tolerance(const double eta)
  {
    constexpr double energy_fraction = 3.; // of what another solve improves
    solver.set_limits(eta,
                      energy_fraction,
                      std::min(along != nullptr ? most_on_path :
                                                  most_linear_iterations,
                               run.parameters.solver.max_iterations));
  }

  SolveReport
  NonlinearStep::solve_tangent(const SystemVector &forces, SystemVector &dx)
  {
    SolveReport report = solver.solve(forces, dx);
    if (!report.converged && discretisation.try_as_indefinite())
      {
        const unsigned int before_that = report.iterations;
        report                         = solver.solve(forces, dx);
        report.iterations += before_that;
      }
    if (!report.converged && report.relative_residual < fair_solve)
      report.converged = true;
    // a digit of the residual
    last_cost = std::max(1u, report.iterations) / -std::log10(report.tolerance);
    least_cost = least_cost == 0. ? last_cost : std::min(least_cost, last_cost);
    return report;
  }
} // namespace mortise
