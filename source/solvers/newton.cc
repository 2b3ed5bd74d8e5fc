#include <mortise/solvers/newton.h>

#include <algorithm>

namespace mortise
{
  namespace
  {
    /// Shorten the increment from @p start to @p x until the residual falls below @p before; both are
    /// updated. Returns how often it was halved, more than @p max_halvings if nothing helps; then x is
    /// the start.
    unsigned int
    search(NonlinearProblem    &problem,
           const NewtonOptions &options,
           const SystemVector  &start,
           SystemVector        &x,
           double              &before)
    {
      const unsigned int max_halvings = options.max_halvings;
      constexpr double   decrease     = 1e-4;
      double             length       = 1.;
      for (unsigned int halvings = 0; halvings <= max_halvings; ++halvings)
        {
          const double reached = problem.residual(x);
          if (reached <= (1. - decrease * length) * before ||
              reached <= options.accepted)
            {
              before = reached;
              return halvings;
            }
          length *= 0.5;
          scale(x, 0.5);
          add_scaled(x, 0.5, start);
        }
      x = start;
      problem.residual(x);
      return max_halvings + 1;
    }
  } // namespace

  NewtonReport
  solve_newton(NonlinearProblem    &problem,
               const NewtonOptions &options,
               SystemVector        &x)
  {
    constexpr unsigned int easy_iterations = 5;
    const bool             searches        = options.max_halvings > 0;
    NewtonReport           report;
    report.residual    = problem.residual(x);
    report.easy        = true;
    double       best  = report.residual;
    unsigned int rises = 0;
    // not a number is not converged
    while (!(report.residual <= options.tolerance) &&
           report.iterations < options.max_iterations)
      {
        problem.linearise(x);
        const SystemVector start  = searches ? x : SystemVector();
        const SolveReport  before = report.linear;
        report.linear             = problem.solve(x);
        report.linear_iterations += report.linear.iterations;
        report.linear.add_seconds(before);
        if (!report.linear.converged)
          {
            if (searches)
              x = start;
            break;
          }
        unsigned int halvings = 0;
        if (searches)
          halvings = search(problem, options, start, x, report.residual);
        else
          report.residual = problem.residual(x);
        if (halvings > options.max_halvings)
          break;
        ++report.iterations;
        report.easy &= halvings == 0;
        if (options.monitor)
          options.monitor(report.iterations, report.residual);
        rises = report.residual < best ? 0 : rises + 1;
        best  = std::min(best, report.residual);
        if (rises >= options.patience)
          break;
      }
    report.converged = report.residual <= options.tolerance;
    report.easy &= report.converged && report.iterations <= easy_iterations;
    return report;
  }
} // namespace mortise
