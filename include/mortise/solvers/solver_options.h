// What a caller may ask of a solver.
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

namespace mortise
{
  enum class SolverMethod
  {
    automatic, ///< chosen by the size of the system; the report says which and
               ///< why
    saddle_point,
    condensed,
    direct
  };

  struct SolverOptions
  {
    SolverMethod method = SolverMethod::automatic;
    double tolerance = 1e-10; ///< of the relative residual, see ScaledResidual
    unsigned int max_iterations = 1000;
    /// Up to so many multipliers C is factorised by all ranks together: 12,000
    /// of 870,000 dofs on 64 ranks take 0.11 s of processor time for all solves
    /// with it, 0.28 s by parts; 83,000 of 10.7 million dofs on two ranks 15.5
    /// + 27.8 s of setup and solve, 11.1 + 29.4 s by parts.
    unsigned int max_gathered = 30000;

    /// So many earlier solutions are kept to start from, see
    /// SuccessiveSolutions.
    unsigned int successive = 0;

    double energy_share = 0.03; ///< of it, see energy_tolerance()

    /// Iterative solvers go on until the root of the estimated energy of the
    /// error, too, is below this fraction of the solution's: on fine meshes a
    /// small residual alone says little.
    double
    energy_tolerance() const
    {
      return std::max(energy_share * tolerance, 1e-12); // what rounding leaves
    }

    /// Called on every rank after each iteration with its number and the
    /// relative residual.
    std::function<void(unsigned int, double)> monitor;
  };

  /// "auto", "saddle point", "condensed", "direct": the names of a parameter
  /// file.
  std::vector<std::string>
  solver_method_names();

  /// The method of that name; throws InputError that lists the names.
  SolverMethod
  solver_method_from_name(const std::string &name);
} // namespace mortise
