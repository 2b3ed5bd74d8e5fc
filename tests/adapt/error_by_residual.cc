// Proves that the error that belongs to a residual is found from what changed
// while residuals fell, and that nothing is believed where nothing was seen.
#include <mortise/adapt/error_by_residual.h>

#include <cmath>
#include <string>

#include "../verdict.h"

using namespace mortise;

int
main()
{
  // squares of errors 0.04 times those of residuals, whatever these fall by
  for (const double fall : {0.1, 0.5, 0.99})
    {
      const double before = 3., now = before * (1. - fall),
                   change = 0.04 * (before - now);
      verdict("error by residual, which fell by " + std::to_string(fall),
              std::fabs(square_by_residual(change, before, now) / 0.04 - 1.),
              1e-12);
    }
  // a solution that a refinement did not see
  verdict("no change, residual falls",
          0.02 / square_by_residual(0., 1., 0.5),
          1.);
  verdict("no change, residual stays",
          square_by_residual_at_first / square_by_residual(0., 1., 1.),
          1.);
  verdict("residual rises",
          square_by_residual_at_first / square_by_residual(0.01, 1., 2.),
          1.);
  verdict("large change, residual stays",
          std::fabs(square_by_residual(5., 1., 1.) / 5. - 1.),
          1e-12);
  verdict("falls by a twentieth",
          falls(1., 0.96) || falls(0., 0.) ? 1. : 0.,
          0.5);
  verdict("falls by more", falls(1., 0.94) ? 0. : 1., 0.5);
  verdict("factor after one and two refinements",
          std::fabs(upper_factor(1) - 1.5) + std::fabs(upper_factor(2) - 1.5),
          1e-12);
  verdict("factor after three", std::fabs(upper_factor(3) - 1.25), 1e-12);
  verdict("factor after many", std::fabs(upper_factor(40) - 7. / 6.), 1e-12);
  verdict("exact before", 0.5 / square_by_residual(0., 0., 0.), 1.);
}
