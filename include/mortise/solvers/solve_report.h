// Report of one linear solve.
#pragma once

#include <string>

namespace mortise
{
  struct SolveReport
  {
    std::string  method;         ///< direct | condensed | saddle point
    std::string  preconditioner; ///< in words
    unsigned int iterations =
      0; ///< of the outer iteration; 0 for a direct solve
    double relative_residual = 0.; ///< |(f - K u - B^T lambda, g - B u)| / |(f,
                                   ///< g)|, as of ScaledResidual
    /// The residual that rounding allows with this system; 0 (not computed) if
    /// the tolerance was reached.
    double attainable = 0.;
    double tolerance  = 0.; ///< what was asked of the residual
    bool   converged  = false;
    bool prepared = true; ///< was the set-up of the preconditioner successful?
    double setup_seconds = 0.; ///< since the last report
    double solve_seconds = 0.;

    void
    add_seconds(const SolveReport &other)
    {
      setup_seconds += other.setup_seconds;
      solve_seconds += other.solve_seconds;
    }
  };
} // namespace mortise
