// --report: a page of results, made by the Python package of source/python.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace mortise
{
  /// If @p arguments, those of the command line, ask for a report, this process
  /// becomes the Python program that makes it, and does not come back; where
  /// that is not possible it says why, and the value is the exit code. No value
  /// if they ask for something else or are wrong. To be called before MPI
  /// begins, which a process must not leave so.
  std::optional<int>
  make_report_if_asked(const std::vector<std::string> &arguments);
} // namespace mortise
