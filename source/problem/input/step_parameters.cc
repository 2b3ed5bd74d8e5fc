#include <mortise/problem/input/step_parameters.h>

#include <algorithm>
#include <cmath>

namespace mortise
{
  namespace
  {
    /// Of one length, or none.
    double
    n_steps(const std::vector<double> &step, const double end)
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
    const double        end = end_time.value_or(1.), n = n_steps(step, end);
    std::vector<double> times;
    for (double i = 1.; i < n; ++i)
      times.push_back(i * step[0]);
    times.push_back(end);
    return times;
  }

  double
  StepParameters::first_time() const
  {
    const double end = end_time.value_or(1.);
    return step.size() > 1 || n_steps(step, end) > 1. ? step[0] : end;
  }
} // namespace mortise
