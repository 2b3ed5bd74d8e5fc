// See solve.h.
#include <mortise/base/error.h>
#include <mortise/solvers/condensed.h>
#include <mortise/solvers/direct.h>
#include <mortise/solvers/saddle_point.h>
#include <mortise/solvers/solve.h>

namespace mortise
{
  namespace
  {
    /// Entries of K up to which a factorisation is taken by default.
    constexpr double max_direct_entries = 1e6;
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
        case SolverMethod::condensed:
          return solve_condensed(system, options, u, lambda);
        case SolverMethod::automatic:
          break;
      }
    const bool  small = system.stiffness.n_nonzero_elements() <= max_direct_entries;
    SolveReport report =
      small ? solve_direct(system, options, u, lambda) : solve_condensed(system, options, u, lambda);
    report.preconditioner += small ? "; auto: small" : "; auto: large";
    return report;
  }
} // namespace mortise
