#include <deal.II/base/timer.h>

#include <mortise/base/timers.h>
#include <mortise/solvers/linear_solver.h>

#include <algorithm>
#include <cmath>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// SolverOptions::energy_fraction of what another solve improves.
    constexpr double loose_energy = 3.;
  } // namespace

  double
  largest_entry(const SystemVector &rhs)
  {
    double largest = 0.;
    for (const Vector *part :
         {&rhs.displacement, &rhs.pressure, &rhs.multiplier})
      if (part->size() > 0)
        largest = std::max(largest, part->linfty_norm());
    return largest;
  }

  double
  unit_scale(const SystemVector &rhs)
  {
    const double largest  = largest_entry(rhs);
    int          exponent = 0;
    if (!std::isfinite(largest) || largest == 0.)
      return 1.;
    std::frexp(largest, &exponent);
    return std::ldexp(1., -exponent);
  }

  LinearSolver::LinearSolver(const BlockSystem   &system,
                             const SolverOptions &options,
                             const std::string   &method)
    : system(system)
    , options(options)
    , method(method)
    , earlier(options.successive)
  {}

  void
  LinearSolver::update()
  {
    update_numbers([this] { return set_up(); });
  }

  void
  LinearSolver::update_active()
  {
    if (!valid || !selects)
      update();
    else
      update([this] { return set_up_active(); });
  }

  void
  LinearSolver::update_interfaces()
  {
    update_numbers([this] { return valid ? set_up_interfaces() : set_up(); });
  }

  void
  LinearSolver::update_directions()
  {
    const bool known = valid && selects;
    update_numbers(
      [this, known] { return known ? set_up_directions() : set_up(); });
  }

  void
  LinearSolver::update_numbers(const std::function<bool()> &set_up_part)
  {
    selects = system.active.has_value();
    update([&] {
      residual = std::make_unique<ScaledResidual>(system);
      return set_up_part();
    });
  }

  void
  LinearSolver::update(const std::function<bool()> &set_up_part)
  {
    announce_stage("solver_setup");
    const Timer timer;
    valid   = set_up_part();
    earlier = SuccessiveSolutions(options.successive);
    setup_seconds += timer.wall_time();
  }

  SolveReport
  LinearSolver::solve(const SystemVector &rhs, SystemVector &x)
  {
    if (!residual)
      update();
    const bool is_zero = earlier.empty() || largest_entry(rhs) == 0.;
    x = is_zero ? system.zero_vector() : earlier.start(rhs, *residual);
    return solve(rhs, x, is_zero);
  }

  SolveReport
  LinearSolver::solve_from(const SystemVector &rhs, SystemVector &x)
  {
    if (!residual)
      update();
    return solve(rhs, x, false);
  }

  SolveReport
  LinearSolver::solve(const SystemVector &rhs,
                      SystemVector       &x,
                      const bool          is_zero)
  {
    announce_stage("solve");
    const Timer timer;
    SolveReport report;
    report.method         = method;
    report.preconditioner = description;

    const double factor = unit_scale(rhs);
    SystemVector scaled = rhs;
    scale(scaled, factor);
    scale(x, factor);
    system.to_directions(scaled, x);
    for (SystemVector *given : {&scaled, &x})
      system.clear_inactive(given->multiplier);
    // nothing is left of it, beside which any start is infinitely wrong
    const bool nothing = largest_entry(scaled) == 0.;
    if (nothing)
      x = system.zero_vector();
    const double asked           = options.tolerance,
                 energy_fraction = options.energy_fraction;
    if (valid && options.reduction > 0. && !nothing)
      {
        SystemVector r = system.zero_vector();
        residual->compute(scaled, x, r);
        options.tolerance = std::max(asked,
                                     options.reduction * residual->norm(r) /
                                       residual->norm(scaled));
        if (options.tolerance > asked)
          options.energy_fraction = loose_energy;
      }
    report.tolerance = options.tolerance;
    if (valid)
      run(scaled, x, is_zero || nothing, report);
    else
      {
        report.prepared          = false;
        report.relative_residual = 1.;
      }
    options.tolerance       = asked;
    options.energy_fraction = energy_fraction;
    scale(x, 1. / factor);
    system.from_directions(x);
    if (report.converged)
      remember(rhs, x);

    report.setup_seconds = setup_seconds;
    setup_seconds        = 0.;
    report.solve_seconds = timer.wall_time();
    return report;
  }

  void
  LinearSolver::remember(const SystemVector &rhs, const SystemVector &x)
  {
    if (!residual)
      update();
    earlier.add(rhs, x, *residual);
  }
} // namespace mortise
