// Conjugate gradients on the subspace { u : B u = 0 }, the condensed system
// written without choosing pairs of slave and master dofs; without an
// interface, ordinary conjugate gradients. It never forms the condensed matrix.
#pragma once

#include <mortise/solvers/linear_solver.h>
#include <mortise/solvers/multigrid/degree_multigrid.h>

namespace mortise
{
  /// Preconditioned conjugate gradients on the positive definite system that is
  /// left when the constraint B u = g has been eliminated; lambda is recovered
  /// at the end.
  class CondensedSolver : public LinearSolver
  {
  public:
    CondensedSolver(const BlockSystem &system, const SolverOptions &options);

  private:
    bool
    set_up() override;

    bool
    set_up_active() override;
    bool
    set_up_interfaces() override;

    void
    run(const SystemVector &rhs,
        SystemVector       &x,
        bool                is_zero,
        SolveReport        &report) override;

    std::unique_ptr<DegreeMultigrid> preconditioner;
  };
} // namespace mortise
