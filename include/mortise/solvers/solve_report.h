// What a solver tells about one solve. It never holds the solution.
#pragma once

#include <string>
#include <vector>

namespace mortise
{
  struct SolveReport
  {
    std::string  method;         ///< direct | condensed | saddle point
    std::string  preconditioner; ///< what was used, in words
    unsigned int iterations =
      0; ///< of the outer iteration; 0 for a direct solve
    double relative_residual = 0.; ///< |(f - K u - B^T lambda, g - B u)| / |(f,
                                   ///< g)|, scaled as documented
    /// What rounding leaves of it with the numbers of this system; 0 where the
    /// tolerance was reached, so that it was not looked at.
    double              attainable = 0.;
    bool                converged  = false;
    std::vector<double> history; ///< residual of each iteration
    double              setup_seconds = 0.;
    double              solve_seconds = 0.;
  };
} // namespace mortise
