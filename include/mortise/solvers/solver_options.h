// Options of the linear solvers.
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

namespace mortise
{
  enum class SolverMethod
  {
    automatic, ///< see choose_solver()
    saddle_point,
    condensed,
    direct
  };

  struct SolverOptions
  {
    SolverMethod method = SolverMethod::automatic;
    double tolerance = 1e-10; ///< of the relative residual, see ScaledResidual
    unsigned int max_iterations = 1000;
    /// The residual of the start may be reduced by this factor alone, if that
    /// is more than the tolerance.
    double reduction = 0.;
    /// Largest number of multipliers for which all ranks factorise C together,
    /// else by parts. Measured: 12,000 of 870,000 dofs on 64 ranks take 0.11 s
    /// of processor time for all solves, 0.28 s by parts; 83,000 of 10.7
    /// million dofs on two ranks 15.5 + 27.8 s of setup and solve, 11.1 + 29.4
    /// s by parts.
    unsigned int max_gathered = 30000;

    /// Number of earlier solutions that are kept, see SuccessiveSolutions.
    unsigned int successive = 0;

    double energy_fraction = 0.03; ///< see energy_tolerance()

    /// Iterative solvers also bound the estimated error in the energy norm,
    /// relative to the solution, since on fine meshes a small residual does not
    /// imply it.
    double
    energy_tolerance() const
    {
      return std::max(energy_fraction * tolerance,
                      1e-12); // what rounding leaves
    }

    /// Called on every rank after each iteration with its number and the
    /// relative residual.
    std::function<void(unsigned int, double)> monitor;
  };

  /// The names in parameter files, in the order of SolverMethod.
  std::vector<std::string>
  solver_method_names();

  /// The method of that name; throws InputError that lists the names.
  SolverMethod
  solver_method_from_name(const std::string &name);
} // namespace mortise
