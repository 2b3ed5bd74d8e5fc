#include <mortise/base/error.h>
#include <mortise/solvers/condensed.h>
#include <mortise/solvers/direct.h>
#include <mortise/solvers/saddle_point.h>
#include <mortise/solvers/solve.h>

namespace mortise
{
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
    throw InputError("Solver/Method: got \"" + name + "\"; allowed: " + join_names(names));
  }

  SolveReport
  solve(const BlockSystem &system, const SolverOptions &options, Vector &u, Vector &lambda)
  {
    switch (options.method)
      {
        case SolverMethod::direct:
          return solve_direct(system, options, u, lambda);
        case SolverMethod::saddle_point:
          return solve_saddle_point(system, options, u, lambda);
        default:
          return solve_condensed(system, options, u, lambda);
      }
  }
} // namespace mortise
