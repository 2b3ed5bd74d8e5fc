// GMRES on the indefinite system of displacements, pressures and multipliers
// with a block factorisation as preconditioner. K may be singular.
#pragma once

#include <mortise/solvers/krylov/pressure_preconditioner.h>
#include <mortise/solvers/linear_solver.h>
#include <mortise/solvers/multigrid/degree_multigrid.h>

#include <memory>

namespace mortise
{
  /// Preconditioned GMRES from @p solution on, which need not be symmetric. The
  /// preconditioner takes a DegreeMultigrid, the Schur complement of its
  /// ApproximateSchurComplement for the multipliers and @p pressure for
  /// pressures; null without.
  void
  solve_saddle_point(const BlockSystem            &system,
                     const ScaledResidual         &residual,
                     const DegreeMultigrid        &bulk,
                     const PressurePreconditioner *pressure,
                     const SolverOptions          &options,
                     const SystemVector           &rhs,
                     SystemVector                 &solution,
                     SolveReport                  &report);

  /// solve_saddle_point() for systems with multipliers or pressures.
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

    bool
    set_up_directions() override;

    void
    run(const SystemVector &rhs,
        SystemVector       &x,
        bool                is_zero,
        SolveReport        &report) override;

    void
    describe();

    std::unique_ptr<DegreeMultigrid>        bulk;
    std::unique_ptr<PressurePreconditioner> pressure;
  };
} // namespace mortise
