#include <mortise/solvers/newton.h>

#include <cmath>

namespace mortise
{
  namespace
  {
    /// A solution, its residual, and that one's norm.
    struct Iterate
    {
      SystemVector &x;
      SystemVector  r;
      double        norm;
    };

    /// Move the iterate along @p dx until the residual falls. Returns how often the step was
    /// halved, more than @p max_halvings if nothing helps; then it is where it was.
    unsigned int
    search(const NonlinearProblem &problem,
           const SystemVector     &dx,
           const unsigned int      max_halvings,
           Iterate                &at)
    {
      constexpr double decrease = 1e-4;
      double           length   = 1.;
      add_scaled(at.x, length, dx);
      for (unsigned int halvings = 0; halvings <= max_halvings; ++halvings)
        {
          problem.residual(at.x, at.r);
          const double reached = problem.norm(at.r);
          if (reached <= (1. - decrease * length) * at.norm)
            {
              at.norm = reached;
              return halvings;
            }
          length *= 0.5;
          add_scaled(at.x, -length, dx);
        }
      add_scaled(at.x, -length, dx);
      problem.residual(at.x, at.r);
      return max_halvings + 1;
    }
  } // namespace

  NewtonReport
  solve_newton(const NonlinearProblem &problem,
               const NewtonOptions    &options,
               SystemVector           &x)
  {
    constexpr unsigned int easy_iterations = 5;
    const double           target          = options.tolerance * options.scale;
    NewtonReport           report;
    Iterate                at{x, x, 0.};
    SystemVector           dx = x;
    problem.residual(x, at.r);
    at.norm     = problem.norm(at.r);
    report.easy = true;
    // not a number is not converged
    while (!(at.norm <= target) && report.iterations < options.max_iterations)
      {
        problem.linearise(x);
        scale(dx, 0.);
        const SolveReport linear = problem.solve(at.r, dx);
        report.linear_iterations += linear.iterations;
        if (!linear.converged)
          break;
        const unsigned int halvings =
          search(problem, dx, options.max_halvings, at);
        if (halvings > options.max_halvings)
          break;
        ++report.iterations;
        report.easy &= halvings == 0;
        if (options.monitor)
          options.monitor(report.iterations, at.norm / options.scale);
      }
    report.converged         = at.norm <= target;
    report.relative_residual = at.norm / options.scale;
    report.easy &= report.converged && report.iterations <= easy_iterations;
    return report;
  }
} // namespace mortise
