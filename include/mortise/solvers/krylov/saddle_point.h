// GMRES on the indefinite system of displacements, pressures and multipliers
// with a block factorisation as preconditioner. K may be singular.
#pragma once

#include <mortise/solvers/linear_solver.h>

namespace mortise
{
  /// Preconditioned GMRES; the preconditioner takes a DegreeMultigrid, the
  /// Schur complement of its ApproximateSchurComplement for the multipliers and
  /// a PressurePreconditioner. Only for systems with multipliers or pressures.
  class SaddlePointSolver : public LinearSolver
  {
  public:
    SaddlePointSolver(const BlockSystem &system, const SolverOptions &options);
    ~SaddlePointSolver() override;

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

    struct Parts; ///< scaled operator and preconditioner
    std::unique_ptr<Parts> parts;
  };
} // namespace mortise
