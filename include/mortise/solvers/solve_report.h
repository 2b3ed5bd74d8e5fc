// What a solver tells about one solve.
#pragma once

#include <string>

namespace mortise
{
  struct SolveReport
  {
    std::string  method;         ///< direct | condensed | saddle point
    std::string  preconditioner; ///< what was used, in words
    unsigned int iterations =
      0; ///< of the outer iteration; 0 for a direct solve
    double relative_residual = 0.; ///< |(f - K u - B^T lambda, g - B u)| / |(f,
                                   ///< g)|, as of ScaledResidual
    /// What rounding leaves of it with the numbers of this system; 0 where the
    /// tolerance was reached, so that it was not looked at.
    double attainable    = 0.;
    bool   converged     = false;
    bool   prepared      = true; ///< did the set-up give a preconditioner?
    double setup_seconds = 0.;   ///< since the last report
    double solve_seconds = 0.;
  };
} // namespace mortise
