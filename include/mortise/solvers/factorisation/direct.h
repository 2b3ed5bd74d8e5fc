// Direct solution of the monolithic saddle-point system [K G^T B^T; G -C 0; B 0
// 0] with iterative refinement: small scenes and reference.
#pragma once

#include <mortise/solvers/linear_solver.h>

namespace mortise
{
  /// A sparse factorisation (MUMPS). Works on any number of ranks, those
  /// without dofs included.
  class DirectSolver : public LinearSolver
  {
  public:
    DirectSolver(const BlockSystem &system, const SolverOptions &options);
    ~DirectSolver() override;

  private:
    bool
    set_up() override;

    void
    run(const SystemVector &rhs,
        SystemVector       &x,
        bool                is_zero,
        SolveReport        &report) override;

    struct Factors;
    std::unique_ptr<Factors> factors;
  };
} // namespace mortise
