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
    /// Limit of the memory of a factorisation.
    constexpr unsigned int max_direct_dofs = 100000;
    /// Stiff bodies on soft ones: preconditioners in single precision resolve
    /// their motion up to a contrast of 1e7 (tests/solvers/contrast.cc).
    constexpr double largest_contrast = 1e6;
    /// Bodies on springs, in double precision up to 1e10: additional iterations
    /// cost less than a factorisation. The saddle point method, which bounds
    /// residuals and not energies, needs 36 at about 5e8 and more than 1000 at
    /// 5e9.
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
