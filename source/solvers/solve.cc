// See solve.h.
#include <mortise/base/error.h>
#include <mortise/solvers/condensed.h>
#include <mortise/solvers/direct.h>
#include <mortise/solvers/saddle_point.h>
#include <mortise/solvers/solve.h>

#include <algorithm>
#include <string>

namespace mortise
{
  namespace
  {
    /// A factorisation (MUMPS, one core, setup included) is the fastest up to about 2,500 p^2 dofs, since
    /// dense blocks suit it: 11,718 dofs of degree 2: 3.5 s against 2.5 s; 21,846 of degree 5: 9 s
    /// against 24 s; 94,776 of degree 6: 47 s against 142 s. Its memory sets the second limit.
    constexpr unsigned int direct_dofs     = 2500;
    constexpr unsigned int max_direct_dofs = 100000;

    /// Above this degree MINRES takes fewer iterations than the condensed system.
    constexpr unsigned int max_condensed_degree = 4;
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
    const bool        has_interface = system.owned_multiplier.size() > 0;
    const auto        size = system.owned_displacement.size() + system.owned_multiplier.size();
    SolveReport       report;
    const std::string degree = std::to_string(system.max_degree);
    if (size <= std::min(direct_dofs * system.max_degree * system.max_degree, max_direct_dofs))
      {
        report = solve_direct(system, options, u, lambda);
        report.preconditioner += "; chosen for few dofs";
      }
    else if (!has_interface || system.max_degree <= max_condensed_degree)
      {
        report = solve_condensed(system, options, u, lambda);
        report.preconditioner += has_interface ? "; chosen for degree " + degree : "; no interface";
      }
    else
      {
        report = solve_saddle_point(system, options, u, lambda);
        report.preconditioner += "; chosen for degree " + degree;
      }
    return report;
  }
} // namespace mortise
