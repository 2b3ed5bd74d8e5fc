// NonlinearStep with arc-length control: the tangent is bordered by the
// derivative of forces with respect to time, and by ArcLength.
#include <mortise/problem/nonlinear_step.h>

#include <algorithm>
#include <limits>

namespace mortise
{
  void
  NonlinearStep::set_time(const double time)
  {
    if (time == time_of_load)
      return;
    *load        = along->load_at(time);
    time_of_load = time;
  }

  SystemVector
  NonlinearStep::rate_of_forces(const SystemVector &x)
  {
    constexpr double fraction = 1e-3; // of a step; exact for linear loads
    const double     dt       = fraction * along->length;
    const SceneLoad  given    = *load;
    const auto       reached  = response;
    SystemVector     forces   = r;
    Vector           rest     = rest_of_prescribed(x);
    *load                     = along->load_at(x.time + dt);
    balance(x);
    std::swap(forces, r);
    add_scaled(forces, -1., r);
    Vector moved = rest_of_prescribed(x);
    moved -= rest;
    *load    = given;
    response = reached;
    forces   = lifted(forces, moved);
    scale(forces, 1. / dt);
    return forces;
  }

  SolveReport
  NonlinearStep::solve_bordered(const SystemVector &x,
                                const Vector       &rest,
                                SystemVector       &dx)
  {
    const SystemVector rate = rate_of_forces(x);
    const double       rise = norm->norm(rate) * along->length;
    if (rise == 0.)
      run.parameters.fail("Steps/Control",
                          "arc length where nothing that acts depends on t",
                          "load, or loads or displacements that grow with t");
    reference = std::max(reference, rise);
    if (!arc->has_tangent()) // by which lengths are measured
      set_tolerance(run.parameters.solver.tolerance);
    SystemVector per_time;
    SolveReport  report = solve_tangent(rate, per_time);
    dx                  = discretisation.linear_system().zero_vector();
    if (report.converged && !balanced)
      {
        const unsigned int before_that = report.iterations;
        report                         = solve_tangent(lifted(r, rest), dx);
        report.iterations += before_that;
      }
    dx.time = arc->increment_of_time(x.displacement,
                                     dx.displacement,
                                     per_time.displacement);
    add_scaled(dx, dx.time, per_time);
    return report;
  }

  SolveReport
  NonlinearStep::solve(const PathStep &step,
                       SceneLoad      &given,
                       const State    &last,
                       State          &next)
  {
    load         = &given;
    data         = nullptr;
    contact      = nullptr;
    along        = &step;
    time_of_load = std::numeric_limits<double>::quiet_NaN();
    arc->begin(last, step.length);
    SystemVector     x        = first_iterate(last);
    SolveReport      report   = iterate(last, x);
    constexpr double rounding = 1e-9;
    if (report.converged && x.time > (1. - rounding) * step.end)
      {
        x.time = step.end; // given for the rest of the way
        set_time(x.time);
        along                         = nullptr;
        const unsigned int iterations = newton.iterations;
        report                        = iterate(last, x);
        newton.iterations += iterations;
      }
    along = nullptr;
    finish(x, next);
    next.time = x.time;
    next.path = arc->path(x.displacement);
    return report;
  }
} // namespace mortise
