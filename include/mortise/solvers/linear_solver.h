// Base class of the solvers of the linear system: set up once, solves for many
// right hand sides, updated when the system changes.
#pragma once

#include <mortise/operators/block_system.h>
#include <mortise/solvers/scaled_residual.h>
#include <mortise/solvers/solve_report.h>
#include <mortise/solvers/solver_options.h>
#include <mortise/solvers/successive_solutions.h>

#include <functional>
#include <memory>
#include <string>

namespace mortise
{
  class LinearSolver
  {
  public:
    virtual ~LinearSolver() = default;

    /// Make the preconditioner or factorisation from the present values of the
    /// system; to be called after each change of them. The first solve() calls
    /// it. Collective.
    void
    update();

    /// To be called if BlockSystem::active alone has changed: coarse levels
    /// keep the penalties of the last update(). Calls update() the first time.
    /// Collective.
    void
    update_active();

    /// To be called if BlockSystem::directions and active alone have changed.
    /// Calls update() the first time. Collective.
    void
    update_directions();

    /// To be called if the interfaces alone have been paired again:
    /// preconditioners of the bulk are kept, with the penalties of the last
    /// update(). Collective.
    void
    update_interfaces();

    /// Was the last update a success?
    bool
    is_ready() const
    {
      return valid;
    }

    /// Set the limits of later solves in place of those of SolverOptions.
    void
    set_limits(const double       tolerance,
               const double       energy_fraction,
               const unsigned int max_iterations,
               const double       reduction = 0.)
    {
      options.tolerance       = tolerance;
      options.energy_fraction = energy_fraction;
      options.max_iterations  = max_iterations;
      options.reduction       = reduction;
    }

    /// Solve for @p rhs = (f, h, g), starting at zero. Without convergence the
    /// report has converged == false and @p x is the last iterate. The residual
    /// reported is computed from the equations, relative to @p rhs. Collective.
    ///
    /// The right hand side is scaled by a power of two, so that preconditioners
    /// in single precision are far from their limits.
    SolveReport
    solve(const SystemVector &rhs, SystemVector &x);

    /// As solve(), starting at @p x. Collective.
    SolveReport
    solve_from(const SystemVector &rhs, SystemVector &x);

    /// Add @p x, which solves the system for @p rhs, to the SuccessiveSolutions
    /// from which later solves start. Collective.
    void
    remember(const SystemVector &rhs, const SystemVector &x);

  protected:
    /// @p system must stay alive and keep its structure. @p method: for reports.
    LinearSolver(const BlockSystem   &system,
                 const SolverOptions &options,
                 const std::string   &method);

    /// False on all ranks if the method cannot solve the system; run() is not
    /// called then.
    virtual bool
    set_up() = 0;

    /// As set_up(), for update_active().
    virtual bool
    set_up_active()
    {
      return set_up();
    }

    /// As set_up(), for update_interfaces().
    virtual bool
    set_up_interfaces()
    {
      return set_up();
    }

    /// As set_up(), for update_directions().
    virtual bool
    set_up_directions()
    {
      return set_up();
    }

    /// @p x is a start of the right size, zero if @p is_zero. Sets all of @p report but its
    /// names and times.
    virtual void
    run(const SystemVector &rhs,
        SystemVector       &x,
        bool                is_zero,
        SolveReport        &report) = 0;

    const BlockSystem &system;
    SolverOptions      options;
    std::string        description; ///< of the preconditioner, in words
    std::unique_ptr<ScaledResidual> residual;

  private:
    void
    update(const std::function<bool()> &set_up_part);
    /// The same with the scales of the residual.
    void
    update_numbers(const std::function<bool()> &set_up_part);
    SolveReport
    solve(const SystemVector &rhs, SystemVector &x, bool is_zero);

    const std::string   method;
    SuccessiveSolutions earlier;
    bool                valid = false;
    bool   selects       = false; ///< did the last update() know active ones?
    double setup_seconds = 0.;    ///< of update(), until it is reported
  };

  /// The power of two that brings the largest entry of @p rhs between 1/2 and 1; 1 if all are
  /// zero or one is not finite. Collective.
  double
  unit_scale(const SystemVector &rhs);

  /// The largest entry of @p rhs in magnitude. Collective.
  double
  largest_entry(const SystemVector &rhs);
} // namespace mortise
