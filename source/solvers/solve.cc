// See solve.h.
#include <deal.II/base/exceptions.h>

#include <mortise/base/error.h>
#include <mortise/solvers/factorisation/direct.h>
#include <mortise/solvers/krylov/condensed.h>
#include <mortise/solvers/krylov/saddle_point.h>
#include <mortise/solvers/solve.h>

#include <string>

namespace mortise
{
  namespace
  {
    /// What a factorisation may need of memory.
    constexpr unsigned int max_direct_dofs = 100000;
    /// A stiff body that a soft one holds: preconditioners in single precision
    /// see how it moves up to a contrast of 1e7 (tests/solvers/contrast.cc).
    constexpr double largest_contrast = 1e6;
    /// Bodies that springs hold, in double precision up to 1e10: fewer
    /// iterations are lost than a factorisation costs. Of the saddle point
    /// method, which makes residuals small and not energies, 36 at about 5e8
    /// and more than 1000 at 5e9.
    constexpr double largest_contrast_of_springs = 1e9;
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
      {
        const SolverChoice best = choose_solver(SolverMethod::automatic, scene);
        return {asked,
                "",
                best.method != SolverMethod::direct || asked == best.method ?
                  "" :
                  "Solver/Method = auto, which here is direct (" + best.reason +
                    ")"};
      }
    if (scene.contrast > largest_contrast &&
        scene.n_displacements <= max_direct_dofs)
      return {SolverMethod::direct,
              "chosen since moduli differ by more than a million"};
    if (scene.contrast_of_springs > largest_contrast_of_springs &&
        scene.n_displacements <= max_direct_dofs)
      return {SolverMethod::direct,
              "chosen since springs are softer than bodies by more than a "
              "thousand million"};
    if (scene.mixed)
      return {SolverMethod::saddle_point, "chosen in mixed form"};
    return {SolverMethod::condensed, "chosen in displacement form"};
  }

  std::unique_ptr<LinearSolver>
  make_linear_solver(const BlockSystem &system, const SolverOptions &options)
  {
    const bool definite =
      system.owned_multiplier.size() == 0 && !system.mixed();
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
