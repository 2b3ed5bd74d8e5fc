// Newton's method for a system A(x) = b, by three contracts of the problem.
#pragma once

#include <mortise/operators/block_system.h>
#include <mortise/solvers/solve_report.h>

#include <functional>

namespace mortise
{
  /// What Newton's method asks of a problem.
  struct NonlinearProblem
  {
    /// r = b - A(x).
    std::function<void(const SystemVector &x, SystemVector &r)> residual;
    /// The next solves take the derivative of A at x.
    std::function<void(const SystemVector &x)> linearise;
    /// dx = A'(x)^{-1} r, to a tolerance relative to r.
    std::function<SolveReport(const SystemVector &r, SystemVector &dx)> solve;
    /// Of a residual, free of units.
    std::function<double(const SystemVector &r)> norm;
  };

  struct NewtonOptions
  {
    double       tolerance      = 1e-10; ///< |r| over scale
    double       scale          = 1.;    ///< usually |b|
    unsigned int max_iterations = 20;
    unsigned int max_halvings   = 8; ///< of one increment
    /// Called after each iteration with its number and |r| / scale.
    std::function<void(unsigned int, double)> monitor;
  };

  struct NewtonReport
  {
    bool         converged         = false;
    unsigned int iterations        = 0;
    unsigned int linear_iterations = 0; ///< of all linear solves
    double       relative_residual = 0.;
    /// Few iterations, no increment halved: the next load step may be longer.
    bool easy = false;
  };

  /// Improve @p x. An increment that does not lower the residual (Armijo's
  /// rule on |r|^2) is halved; where that does not help, or a linear solve
  /// fails, x is the best iterate and the report not converged. Collective if
  /// the contracts are.
  NewtonReport
  solve_newton(const NonlinearProblem &problem,
               const NewtonOptions    &options,
               SystemVector           &x);
} // namespace mortise
