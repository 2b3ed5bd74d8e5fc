// Choice and construction of a linear solver.
#pragma once

#include <mortise/solvers/linear_solver.h>

namespace mortise
{
  struct SolverChoice
  {
    SolverMethod method; ///< never automatic
    std::string  reason; ///< empty when the method was asked for
    /// Advice to use a factorisation, with the reason, if an iterative method
    /// was asked for; else empty.
    std::string advice = "";
  };

  /// Criteria of the choice.
  struct SceneSize
  {
    dealii::types::global_dof_index n_displacements;
    bool                            mixed;    ///< has pressures
    double                          contrast; ///< largest ratio of moduli
    /// Largest ratio of moduli to those of springs, stiffness times length.
    double contrast_of_springs = 1.;
  };

  /// The method for a scene: the given one, or chosen by measurements.
  SolverChoice
  choose_solver(SolverMethod asked, const SceneSize &scene);

  /// The solver of the method in @p options, which is never automatic; to be
  /// updated before its first solve. @p system must stay alive.
  std::unique_ptr<LinearSolver>
  make_linear_solver(const BlockSystem &system, const SolverOptions &options);
} // namespace mortise
