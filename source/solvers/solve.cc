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
    /// A factorisation (MUMPS, one core, setup included) is the fastest up to
    /// about 2,500 p^2 dofs, since dense blocks suit it: 11,718 dofs of degree
    /// 2: 3.5 s against 2.5 s; 21,846 of degree 5: 9 s against 24 s; 94,776 of
    /// degree 6: 47 s against 142 s. Its memory sets the second limit.
    constexpr unsigned int direct_dofs     = 2500;
    constexpr unsigned int max_direct_dofs = 100000;
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
  choose_solver(const SolverMethod                    asked,
                const dealii::types::global_dof_index n_displacements,
                const unsigned int                    max_degree)
  {
    if (asked != SolverMethod::automatic)
      return {asked, ""};
    const auto limit =
      std::min(direct_dofs * max_degree * max_degree, max_direct_dofs);
    if (n_displacements <= limit)
      return {SolverMethod::direct,
              "chosen for at most " + std::to_string(limit) + " dofs"};
    return {SolverMethod::condensed,
            "chosen for more than " + std::to_string(limit) + " dofs"};
  }

  SolveReport
  solve(const BlockSystem   &system,
        const SolverOptions &options,
        Vector              &u,
        Vector              &lambda)
  {
    const SolverChoice choice = choose_solver(options.method,
                                              system.owned_displacement.size(),
                                              system.max_degree);
    SolveReport        report = choice.method == SolverMethod::direct ?
                                  solve_direct(system, options, u, lambda) :
                                choice.method == SolverMethod::saddle_point ?
                                  solve_saddle_point(system, options, u, lambda) :
                                  solve_condensed(system, options, u, lambda);
    if (!choice.reason.empty())
      report.preconditioner += "; " + choice.reason;
    return report;
  }
} // namespace mortise
