// What of a deck has no counterpart in a scene.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <map>
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
      add(left[what], place);
    }

    void
    approximated(const std::string &place, const std::string &what)
    {
      add(changed[what], place);
    }

    /// A line for each, by the lines of the deck.
    std::vector<std::string>
    lines() const
    {
      std::vector<std::string> text;
      append(left, "Left out:", text);
      append(changed, "Approximated:", text);
      return text;
    }

  private:
    using Places = std::vector<std::string>;
    using List   = std::map<std::string, Places>; ///< by what is told

    static void
    add(Places &places, const std::string &place)
    {
      if (places.empty() || places.back() != place)
        places.push_back(place);
    }

    /// Of "line 12"; others are last.
    static unsigned long
    number_of(const std::string &place)
    {
      return place.rfind("line ", 0) == 0 ?
               std::strtoul(place.c_str() + 5, nullptr, 10) :
               std::numeric_limits<unsigned long>::max();
    }

    static void
    append(const List               &list,
           const std::string        &title,
           std::vector<std::string> &text)
    {
      if (!list.empty())
        text.push_back(title);
      std::vector<const List::value_type *> sorted;
      for (const auto &remark : list)
        sorted.push_back(&remark);
      std::stable_sort(sorted.begin(),
                       sorted.end(),
                       [](const auto *a, const auto *b) {
                         return number_of(a->second[0]) <
                                number_of(b->second[0]);
                       });
      for (const auto *remark : sorted)
        {
          const Places     &places = remark->second;
          const std::size_t shown  = std::min<std::size_t>(places.size(), 3);
          std::string       where  = places[0];
          for (std::size_t i = 1; i < shown; ++i)
            where += ", " + places[i];
          if (places.size() > shown)
            where += " and " + std::to_string(places.size() - shown) + " more";
          text.push_back("  " + where + ": " + remark->first);
        }
    }

    List left, changed;
  };
} // namespace mortise
