// What iterative solvers ask of a preconditioner of the bulk, whatever it is
// made of.
#pragma once

#include <mortise/operators/block_system.h>
#include <mortise/solvers/interface/constraint_projector.h>
#include <mortise/solvers/solver_options.h>

#include <memory>
#include <string>

namespace mortise
{
  /// An approximate inverse of the elasticity block, with the springs in it,
  /// symmetric and positive definite on what projector() leaves, hence usable
  /// between projections in conjugate gradients and GMRES.
  class BulkPreconditioner
  {
  public:
    virtual ~BulkPreconditioner() = default;

    /// Build for @p system, which must stay alive. Collective. False, on every
    /// rank, when the matrix turned out not to be positive definite or the
    /// multipliers not to be independent; nothing else may be called then.
    virtual bool
    initialize(const BlockSystem &system) = 0;

    /// The same after LinearSolver::update_active(). Collective.
    virtual bool
    update_active() = 0;

    /// dst = approximate solution for src; dst and src are distinct.
    /// Collective.
    virtual void
    vmult(Vector &dst, const Vector &src) const = 0;

    /// What springs carry for the last dst, zero for ties; with springs alone.
    virtual const Vector &
    spring_multipliers() const = 0;

    /// Null without an interface.
    virtual const ConstraintProjector *
    projector() const = 0;

    /// What was built, in words.
    virtual std::string
    description() const = 0;
  };

  /// The one that suits the form in which @p system has K, not initialized.
  std::unique_ptr<BulkPreconditioner>
  make_bulk_preconditioner(const BlockSystem   &system,
                           const SolverOptions &options);
} // namespace mortise
