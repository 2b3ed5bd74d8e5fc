#include <mortise/adapt/error_tail.h>

#include <algorithm>
#include <cmath>

namespace mortise
{
  namespace
  {
    /// Changes fall at least with the square of the degree: more slowly they do
    /// beside no corner, and what a cell does by chance is no rule.
    constexpr double least_decay = 2., largest_decay = 40.;

    constexpr double largest_ratio = 0.8; ///< where one change is known

    /// Where a solution is smooth a degree more makes an error at most ten
    /// times, at least twice smaller.
    constexpr double least_smooth_ratio = 0.01, largest_smooth_ratio = 0.25;

    ErrorTail
    tail_of(const double ratio)
    {
      return {ratio / (1. - ratio), ratio};
    }
  } // namespace

  ErrorTail
  geometric_tail(const double       change,
                 const double       before,
                 const unsigned int n_steps,
                 const double       least_ratio)
  {
    const double ratio =
      before > 0. ? std::pow(change / before, 1. / n_steps) : largest_ratio;
    return tail_of(std::min(largest_ratio, std::max(least_ratio, ratio)));
  }

  ErrorTail
  smooth_tail(const double change, const double before, const double decay)
  {
    const double least = std::max(least_smooth_ratio, decay * decay);
    const double ratio = geometric_tail(change, before, 1, least).ratio;
    return tail_of(std::min(largest_smooth_ratio, ratio));
  }

  ErrorTail
  smooth_split_tail(const unsigned int degree)
  {
    return tail_of(std::pow(0.5, degree));
  }

  ErrorTail
  power_tail(const unsigned int p, const double change, const double before)
  {
    const double decay =
      change > 0. ?
        std::min(largest_decay,
                 std::max(least_decay,
                          std::log(before / change) / std::log(p / (p - 1.)))) :
        largest_decay;
    // a few terms and the integral of the rest
    constexpr unsigned int n_terms = 10;
    const double           end     = p + n_terms + 0.5;
    const double           next    = std::pow((p + 1.) / p, -decay);
    double tail = std::pow(end / p, -decay) * end / (decay - 1.);
    for (unsigned int q = p + 1; q <= p + n_terms; ++q)
      tail += std::pow(q / double(p), -decay);
    return {tail, 1. - next / tail};
  }
} // namespace mortise
