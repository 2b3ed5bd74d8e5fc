// Sets as ascending lists.
#pragma once

#include <algorithm>
#include <vector>

namespace mortise
{
  /// Each entry of @p list once, in ascending order.
  template <typename Number>
  void
  sort_unique(std::vector<Number> &list)
  {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
} // namespace mortise
