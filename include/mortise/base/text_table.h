// Tables of words, for the log and for what options print.
#pragma once

#include <string>
#include <vector>

namespace mortise
{
  /// A line for each row, which may have fewer words than others, in columns
  /// with
  /// two blanks before each. @p numbers: words stand on the right of all columns
  /// but the first.
  std::string
  text_table(const std::vector<std::vector<std::string>> &rows, bool numbers);
} // namespace mortise
