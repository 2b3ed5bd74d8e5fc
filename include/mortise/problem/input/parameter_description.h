// What a parameter means and what is allowed, in words and as checks.
#pragma once

#include <mortise/base/error.h>

#include <functional>
#include <string>
#include <vector>

namespace mortise
{
  /// Allowed values of a parameter in words and as checks.
  struct Allowed
  {
    std::string                 words;
    std::function<bool(double)> contains{}; ///< empty: any number
    std::vector<std::string>    choices{};  ///< empty: any text

    static Allowed
    positive_number()
    {
      return {"a positive number",
              [](const double value) { return value > 0.; }};
    }

    static Allowed
    integer(unsigned int least, unsigned int most = no_limit);

    static Allowed
    one_of(const std::vector<std::string> &names)
    {
      return {names.size() == 1 ? names[0] : "one of: " + join_names(names),
              {},
              names};
    }

    static constexpr unsigned int no_limit = 0x7fffffff;
  };

  /// What a parameter means, and its unit, which stands in the text at "[]".
  struct Meaning
  {
    Meaning(const char *text, const std::string &unit = "");

    std::string text; ///< with the unit
    std::string unit; ///< empty: none
  };
} // namespace mortise
