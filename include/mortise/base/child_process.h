// Work in a process of its own, for libraries that may crash or that cannot be
// used twice.
#pragma once

#include <functional>
#include <vector>

namespace mortise
{
  /// What @p work returns, done in a copy of this process that sees its data and
  /// prints no errors. @p work must not use MPI, and what it changes is lost.
  /// Throws std::bad_alloc if memory runs out there, and std::runtime_error
  /// with how it ended if it does not come to its end otherwise.
  std::vector<char>
  in_child_process(const std::function<std::vector<char>()> &work);
} // namespace mortise
