// The clock of programs that report times.
#pragma once

#include <algorithm>
#include <chrono>
#include <vector>

inline double
seconds()
{
  return std::chrono::duration<double>(
           std::chrono::steady_clock::now().time_since_epoch())
    .count();
}

/// Median of the seconds of @p task over some runs.
template <typename Task>
double
median_time(const Task &task)
{
  std::vector<double> times;
  for (unsigned int run = 0; run < 9; ++run)
    {
      const double start = seconds();
      task();
      times.push_back(seconds() - start);
    }
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}
