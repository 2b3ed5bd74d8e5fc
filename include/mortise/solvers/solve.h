// The one entrance to the linear solvers: chooses a method, and makes its
// solver.
#pragma once

#include <mortise/solvers/linear_solver.h>

namespace mortise
{
  struct SolverChoice
  {
    SolverMethod method; ///< never automatic
    std::string  reason; ///< empty when the method was asked for
    /// Where iterations were asked for and a factorisation would have been
    /// chosen: that, and why; else empty.
    std::string advice = "";
  };

  /// What the choice depends on.
  struct SceneSize
  {
    dealii::types::global_dof_index n_displacements;
    bool                            mixed;    ///< has pressures
    double                          contrast; ///< largest ratio of moduli
    /// Likewise, of moduli to what springs carry, stiffness times length.
    double contrast_of_springs = 1.;
  };

  /// The method for a scene: what was asked for, else the one that measurements
  /// favour.
  SolverChoice
  choose_solver(SolverMethod asked, const SceneSize &scene);

  /// The solver of the method in @p options, which is never automatic; to be
  /// updated before its first solve. @p system must stay alive.
  std::unique_ptr<LinearSolver>
  make_linear_solver(const BlockSystem &system, const SolverOptions &options);
} // namespace mortise
