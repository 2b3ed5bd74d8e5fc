// What a caller may ask of a solver. It never solves and reads no file.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace mortise
{
  enum class SolverMethod
  {
    automatic, ///< chosen by the size of the system; the report says which and why
    saddle_point,
    condensed,
    direct
  };

  struct SolverOptions
  {
    SolverMethod method         = SolverMethod::automatic;
    double       tolerance      = 1e-10; ///< relative residual, see ScaledResidual
    unsigned int max_iterations = 1000;

    /// Called on every rank after each iteration with its number and the relative residual.
    std::function<void(unsigned int, double)> monitor;
  };

  /// "auto", "saddle point", "condensed", "direct": the names of a parameter file.
  std::vector<std::string>
  solver_method_names();

  /// The method of that name; throws InputError that lists the names.
  SolverMethod
  solver_method_from_name(const std::string &name);
} // namespace mortise
