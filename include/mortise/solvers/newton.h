// Newton's method for A(x) = b, where A may be piecewise smooth: with contact
// the generalised derivative belongs to an active set, and the method is the
// primal-dual active set strategy. Source: Hintermueller, Ito, Kunisch (2002).
#pragma once

#include <mortise/operators/block_system.h>
#include <mortise/solvers/solve_report.h>

#include <functional>
#include <limits>

namespace mortise
{
  /// A nonlinear problem A(x) = b for Newton's method. Collective.
  class NonlinearProblem
  {
  public:
    virtual ~NonlinearProblem() = default;

    /// Evaluate b - A(x); returns its size, free of units. With contact the
    /// active set that follows from x is chosen, and the fraction of
    /// multipliers that it changes is part of the size.
    virtual double
    residual(const SystemVector &x) = 0;

    /// The next solve() takes a generalised derivative A' at @p x, which was
    /// evaluated last.
    virtual void
    linearise(const SystemVector &x) = 0;

    /// x += A'^{-1} (b - A(x)) for the x of linearise(), as exactly as the next
    /// evaluation needs.
    virtual SolveReport
    solve(SystemVector &x) = 0;
  };

  struct NewtonOptions
  {
    double       tolerance      = 1e-10; ///< of NonlinearProblem::residual()
    unsigned int max_iterations = 20;
    /// Of one increment, where the residual does not fall; 0: full increments,
    /// for piecewise linear problems.
    unsigned int max_halvings = 8;
    /// An increment is also taken if the residual stays below this, unless it
    /// is the best iterate: where bodies bend, residuals grow before they fall.
    double accepted = 0.;
    /// Iterations after which the residual must be less than ever.
    unsigned int patience = std::numeric_limits<unsigned int>::max();
    /// Called after each iteration with its number and the residual.
    std::function<void(unsigned int, double)> monitor;
  };

  struct NewtonReport
  {
    bool         converged         = false;
    unsigned int iterations        = 0;
    unsigned int linear_iterations = 0; ///< of all linear solves
    double       residual          = 0.;
    SolveReport  linear; ///< of the last solve, with the seconds of all
    /// Few iterations, no increment halved: the next load step may be longer.
    bool easy = false;
  };

  /// Improve @p x. An increment that does not lower the residual (Armijo's
  /// rule on its square), nor is accepted all the same, is halved; where that
  /// does not help, or a linear solve fails, x is the best iterate and the
  /// report not converged. Collective.
  NewtonReport
  solve_newton(NonlinearProblem    &problem,
               const NewtonOptions &options,
               SystemVector        &x);
} // namespace mortise
