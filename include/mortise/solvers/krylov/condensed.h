// Projected conjugate gradients on { u : B u = 0 }, equivalent to the condensed
// system, which is not formed; without an interface, ordinary conjugate
// gradients.
#pragma once

#include <mortise/solvers/linear_solver.h>
#include <mortise/solvers/multigrid/degree_multigrid.h>

namespace mortise
{
  /// Preconditioned conjugate gradients on the positive definite system that is
  /// left when the constraint B u = g has been eliminated; lambda is recovered
  /// at the end. GMRES where the system is not symmetric.
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

    bool
    set_up_directions() override;

    void
    run(const SystemVector &rhs,
        SystemVector       &x,
        bool                is_zero,
        SolveReport        &report) override;

    std::unique_ptr<DegreeMultigrid> preconditioner;
  };
} // namespace mortise
