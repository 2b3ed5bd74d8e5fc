#include <mortise/base/text_table.h>

#include <algorithm>

namespace mortise
{
  std::string
  text_table(const std::vector<std::vector<std::string>> &rows,
             const bool                                   numbers)
  {
    std::vector<std::size_t> widths;
    for (const auto &row : rows)
      {
        widths.resize(std::max(widths.size(), row.size()), 0);
        for (std::size_t c = 0; c < row.size(); ++c)
          widths[c] = std::max(widths[c], row[c].size());
      }
    std::string text;
    for (const auto &row : rows)
      {
        std::string line;
        for (std::size_t c = 0; c < row.size(); ++c)
          {
            const std::string blanks(widths[c] - row[c].size(), ' ');
            line += "  ";
            line += numbers && c > 0 ? blanks + row[c] : row[c] + blanks;
          }
        text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
      }
    return text;
  }
} // namespace mortise
