// The one entrance to the solvers: chooses a method, and runs one. It never
// changes the system.
#pragma once

#include <mortise/operators/block_system.h>
#include <mortise/solvers/solve_report.h>
#include <mortise/solvers/solver_options.h>

namespace mortise
{
  struct SolverChoice
  {
    SolverMethod method; ///< never automatic
    std::string  reason; ///< empty when the method was asked for
  };

  /// What the choice depends on.
  struct SceneSize
  {
    dealii::types::global_dof_index n_displacements;
    unsigned int                    max_degree;
    bool                            nodal;    ///< has a NodalSpace
    bool                            mixed;    ///< has pressures
    double                          contrast; ///< largest ratio of moduli
  };

  /// The method for a scene: what was asked for, else the one that measurements
  /// favour.
  SolverChoice
  choose_solver(SolverMethod asked, const SceneSize &scene);

  /// Solve the system by the method of the options, which is never automatic.
  /// Collective.
  ///
  /// @p x is (re)initialised to the owned ranges of the system; what it held is
  /// not used.
  /// A solve that does not reach the tolerance returns converged == false and
  /// the last iterate; nothing is thrown. The reported residual is always
  /// recomputed from the equations.
  SolveReport
  solve(const BlockSystem   &system,
        const SolverOptions &options,
        SystemSolution      &x);
} // namespace mortise
