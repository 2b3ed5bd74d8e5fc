// What of a deck has no counterpart in a scene.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace mortise
{
  class ImportRemarks
  {
  public:
    void
    left_out(const std::string &place, const std::string &what)
    {
      add(left, place, what);
    }

    void
    approximated(const std::string &place, const std::string &what)
    {
      add(changed, place, what);
    }

    /// A line for each, in the order in which they were told.
    std::vector<std::string>
    lines() const
    {
      std::vector<std::string> text;
      for (const auto *list : {&left, &changed})
        {
          if (!list->empty())
            text.emplace_back(list == &left ? "Left out:" : "Approximated:");
          for (const std::string &remark : *list)
            text.push_back("  " + remark);
        }
      return text;
    }

  private:
    static void
    add(std::vector<std::string> &list,
        const std::string        &place,
        const std::string        &what)
    {
      const std::string remark = place + ": " + what;
      if (std::count(list.begin(), list.end(), remark) == 0)
        list.push_back(remark);
    }

    std::vector<std::string> left, changed;
  };
} // namespace mortise
