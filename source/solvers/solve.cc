// See solve.h.
#include <deal.II/base/exceptions.h>

#include <mortise/base/error.h>
#include <mortise/solvers/krylov/condensed.h>
#include <mortise/solvers/factorisation/direct.h>
#include <mortise/solvers/krylov/saddle_point.h>
#include <mortise/solvers/solve.h>

#include <algorithm>
#include <string>

namespace mortise
{
  namespace
  {
    /// Where K needs a matrix, a factorisation (MUMPS) is the fastest up to
    /// about 2,500 p^2 dofs, since dense blocks suit it. Whole runs on one
    /// core, direct against condensed: degree 2, 94,650 dofs: 14 s, 7 s; degree
    /// 4, 30,426: 4.5 s, 6.4 s, and 94,650: 21 s, 18 s; degree 5, 56,661: 13 s,
    /// 15 s; degree 6, 94,776: 44 s, 38 s. Its memory sets the second limit.
    /// Without a matrix condensed wins from the smallest scenes on (720 dofs of
    /// degree 2: 0.05 s, 0.02 s; 27,918 of degree 8: 9.8 s, 0.63 s).
    constexpr unsigned int direct_dofs     = 2500;
    constexpr unsigned int max_direct_dofs = 100000;
    /// A stiff body that a soft one holds: preconditioners in single precision
    /// see how it moves up to a contrast of 1e7 (tests/solvers/contrast.cc).
    constexpr double largest_contrast = 1e6;
  } // namespace

  std::vector<std::string>
  solver_method_names()
  {
    return {"auto", "saddle point", "condensed", "direct"};
  }

  SolverMethod
  solver_method_from_name(const std::string &name)
  {
    const auto names = solver_method_names();
    for (unsigned int i = 0; i < names.size(); ++i)
      if (names[i] == name)
        return static_cast<SolverMethod>(i);
    throw InputError("Solver/Method: got \"" + name +
                     "\"; allowed: " + join_names(names));
  }

  SolverChoice
  choose_solver(const SolverMethod asked, const SceneSize &scene)
  {
    if (asked != SolverMethod::automatic)
      return {asked, ""};
    const SolverMethod iterative =
      scene.mixed ? SolverMethod::saddle_point : SolverMethod::condensed;
    const std::string form = scene.mixed ? " in mixed form" : "";
    if (scene.contrast > largest_contrast &&
        scene.n_displacements <= max_direct_dofs)
      return {SolverMethod::direct,
              "chosen since moduli differ by more than a million"};
    if (scene.nodal)
      return {iterative, "chosen where no matrix is needed" + form};
    const auto limit =
      std::min(direct_dofs * scene.max_degree * scene.max_degree,
               max_direct_dofs);
    if (scene.n_displacements <= limit)
      return {SolverMethod::direct,
              "chosen for at most " + std::to_string(limit) + " dofs"};
    return {iterative,
            "chosen for more than " + std::to_string(limit) + " dofs" + form};
  }

  std::unique_ptr<LinearSolver>
  make_linear_solver(const BlockSystem &system, const SolverOptions &options)
  {
    const bool definite = system.owned_multiplier.size() == 0 && !system.mixed();
    switch (options.method)
      {
        case SolverMethod::direct:
          return std::make_unique<DirectSolver>(system, options);
        case SolverMethod::saddle_point:
          if (!definite)
            return std::make_unique<SaddlePointSolver>(system, options);
          [[fallthrough]]; // conjugate gradients do
        case SolverMethod::condensed:
          return std::make_unique<CondensedSolver>(system, options);
        default:
          Assert(false, dealii::ExcInternalError());
          return {};
      }
  }
} // namespace mortise
