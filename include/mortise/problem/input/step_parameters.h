// Subsection Steps of a parameter file.
#pragma once

#include <optional>
#include <vector>

namespace mortise
{
  /// The times at which load steps end.
  struct StepParameters
  {
    std::optional<double> end_time;
    std::vector<double>   step; ///< one length, or the times at which steps end
    unsigned int          output_every  = 1; ///< of these times
    double                smallest_step = 1e-3;
    std::optional<double> largest_step; ///< a time
    /// Is t an unknown, and the length of a step along the path given?
    bool                        by_arc_length = false;
    std::optional<unsigned int> n_steps; ///< with arc-length control
    /// Do loads grow in proportion to t, from zero at the start to their values
    /// at time 1? No entry of a file.
    bool ramp = false;

    /// If not, there is one step at time 1, and results have no times.
    bool
    given() const
    {
      return end_time || !step.empty();
    }

    double
    last_time() const
    {
      return step.size() > 1 ? step.back() : end_time.value_or(1.);
    }

    /// The times at which steps end, ascending; the first begins at 0. With
    /// arc-length control lengths along the path instead, see ArcLength.
    std::vector<double>
    times() const;

    /// The first of them.
    double
    first_time() const;
  };
} // namespace mortise
