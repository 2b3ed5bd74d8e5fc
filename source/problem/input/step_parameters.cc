#include <mortise/problem/input/step_parameters.h>

#include <algorithm>
#include <cmath>

namespace mortise
{
  namespace
  {
    constexpr unsigned int most_along_path = 100;

    /// With steps of one length, or none.
    double
    n_times(const std::vector<double> &step, const double end)
    {
      // a rest that rounding leaves is no step of its own
      return step.empty() ?
               1. :
               std::max(1., std::ceil(end / step[0] * (1. - 1e-9)));
    }
  } // namespace

  std::vector<double>
  StepParameters::times() const
  {
    if (step.size() > 1)
      return step;
    std::vector<double> times;
    if (by_arc_length)
      {
        for (unsigned int i = 1; i <= n_steps.value_or(most_along_path); ++i)
          times.push_back(i * first_time());
        return times;
      }
    const double end = last_time(), n = n_times(step, end);
    for (double i = 1.; i < n; ++i)
      times.push_back(i * step[0]);
    times.push_back(end);
    return times;
  }

  double
  StepParameters::first_time() const
  {
    return step.size() > 1 || n_times(step, last_time()) > 1. ? step[0] :
                                                                last_time();
  }
} // namespace mortise
