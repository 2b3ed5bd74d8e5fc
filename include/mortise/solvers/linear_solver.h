// What every solver of the linear system is: prepared once, asked for many
// right hand sides, and told when the numbers of the system have changed.
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

    /// Make preconditioner or factorisation from the numbers that the system
    /// holds now; the first solve() does it, later ones need it after every
    /// change of them. Collective.
    void
    update();

    /// After BlockSystem::active has changed, and nothing else: preconditioners
    /// go on with what does not depend on it, coarse levels with the ties that
    /// they saw at the last update(). The first time it is that. Collective.
    void
    update_active();

    /// After the interfaces of the system have been paired again, and nothing
    /// else: what preconditioners know of the bulk stays, coarse levels go on
    /// with the ties that they saw at the last update(). Collective.
    void
    update_interfaces();

    /// How far later solves go on, in place of what SolverOptions have.
    void
    set_limits(const double       tolerance,
               const double       energy_share,
               const unsigned int max_iterations)
    {
      options.tolerance      = tolerance;
      options.energy_share   = energy_share;
      options.max_iterations = max_iterations;
    }

    /// Solve for @p rhs = (f, h, g); what @p x held is not used.
    /// A solve that does not reach the tolerance returns converged == false
    /// and the last iterate; nothing is thrown. The residual reported is always
    /// recomputed from the equations, and relative to @p rhs. Collective.
    ///
    /// The solution is linear in the right hand side: a factor that is a power
    /// of two makes its largest entry one, so that preconditioners in single
    /// precision are far from their limits.
    SolveReport
    solve(const SystemVector &rhs, SystemVector &x);

    /// As solve(), from what @p x holds. Collective.
    SolveReport
    solve_from(const SystemVector &rhs, SystemVector &x);

    /// Later solves may start from @p x, which solves the system for @p rhs, as from what this
    /// solver found itself since the last update(). Collective.
    void
    remember(const SystemVector &rhs, const SystemVector &x);

  protected:
    /// @p system must stay alive and keep its structure. @p method: for reports.
    LinearSolver(const BlockSystem   &system,
                 const SolverOptions &options,
                 const std::string   &method);

    /// Does the method rely on BlockSystem::is_symmetric()? update() throws
    /// InputError where that does not hold.
    virtual bool
    needs_symmetry() const
    {
      return true;
    }

    /// False, on all ranks, when the system turned out not to be what the
    /// method needs; run() is not called then.
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

    /// @p x is a start of the right size, zero if @p is_zero. Sets all of @p report but its
    /// names and times.
    virtual void
    run(const SystemVector &rhs,
        SystemVector       &x,
        bool                is_zero,
        SolveReport        &report) = 0;

    const BlockSystem &system;
    SolverOptions      options;
    std::string        description; ///< what set_up() made, in words
    std::unique_ptr<ScaledResidual> residual;

  private:
    void
    update(const std::function<bool()> &set_up_part);
    /// The same with the residual, whose scales are made of numbers.
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
