// Proves that what is left of series that are known is found from their terms.
#include <mortise/adapt/error_tail.h>

#include <cmath>

#include "../verdict.h"

using namespace mortise;


int
main()
{
  // changes 1 / p^6
  for (const unsigned int p : {3, 5, 8})
    {
      double exact = 0.;
      for (unsigned int q = p + 1; q < 100000; ++q)
        exact += std::pow(q, -6.);
      const double      last = std::pow(p, -6.), before = std::pow(p - 1., -6.);
      const ErrorTail   tail = power_tail(p, last, before);
      const std::string from = " from " + std::to_string(p);
      verdict("powers" + from, std::fabs(tail.left * last / exact - 1.), 1e-2);
      verdict("powers" + from + ", without the next",
              std::fabs(tail.ratio - 1. + std::pow(p + 1., -6.) / exact),
              1e-2);
    }
  // squares of errors r^n: those of changes are the differences
  for (const double r : {0.01, 0.09, 0.2})
    for (const unsigned int n_steps : {1, 2})
      {
        const std::string of = " of " + std::to_string(r);
        const double change = r - r * r, before = change / std::pow(r, n_steps);
        verdict("a series, steps " + std::to_string(n_steps) + of,
                std::fabs(geometric_tail(change, before, n_steps, 0.).left *
                            change / (r * r) -
                          1.),
                1e-12);
        if (n_steps == 1)
          verdict("smooth" + of,
                  std::fabs(smooth_tail(change, before, 0.1).left * change /
                              (r * r) -
                            1.),
                  1e-12);
      }
  // halves of cells of degree p: 4^-p where all is resolved
  verdict("halves",
          std::fabs(geometric_tail(1e-6, 1., 1, std::pow(0.25, 3.)).ratio -
                    1. / 64.),
          1e-15);
  // no error falls faster than its coefficients
  verdict("as coefficients fall",
          std::fabs(smooth_tail(1e-8, 1., 0.2).ratio - 0.04),
          1e-15);
  verdict("others show through",
          std::fabs(smooth_tail(5., 1., 0.2).ratio - 0.25),
          1e-15);
}
