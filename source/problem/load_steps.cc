#include <mortise/problem/load_steps.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mortise
{
  LoadSteps::LoadSteps(const StepParameters &parameters, const bool divisible)
    : times(parameters.times())
    , output_every(parameters.output_every)
    , smallest_fraction(parameters.smallest_step)
    , divisible(divisible)
    , largest(divisible && parameters.largest_step ?
                *parameters.largest_step :
                std::numeric_limits<double>::infinity())
    , length(largest)
  {}

  LoadSteps::LoadSteps(const StepParameters &parameters, const double end)
    : LoadSteps(parameters, true)
  {
    while (times.back() > end)
      times.pop_back();
  }

  double
  LoadSteps::next() const
  {
    // a rest that rounding leaves is no step of its own
    constexpr double rounding = 1e-9;
    const double     rest     = times[n_planned] - reached;
    if (!(length < (1. - rounding) * rest))
      return times[n_planned];
    // steps up to the planned time have one length
    return reached + rest / std::ceil(rest / length - rounding);
  }

  void
  LoadSteps::accept(const bool easy)
  {
    reached    = next();
    at_planned = reached == times[n_planned];
    n_planned += at_planned;
    ++n_accepted;
    if (easy)
      length = std::min(2. * length, largest);
  }

  bool
  LoadSteps::halve()
  {
    const double begin   = n_planned > 0 ? times[n_planned - 1] : 0.;
    const double half    = 0.5 * (next() - reached);
    const double planned = times[n_planned] - begin;
    if (!divisible || half < smallest_fraction * planned)
      return false;
    length = half;
    return true;
  }

  void
  LoadSteps::resume(const double       time,
                    const unsigned int n_steps,
                    const double       longest)
  {
    reached    = time;
    n_accepted = n_steps;
    length     = longest;
    // another end may give the planned times other roundings
    const double rounding = 1e-9 * times.back();
    n_planned = std::upper_bound(times.begin(), times.end(), time + rounding) -
                times.begin();
    at_planned = n_planned > 0 && times[n_planned - 1] > time - rounding;
  }
} // namespace mortise
