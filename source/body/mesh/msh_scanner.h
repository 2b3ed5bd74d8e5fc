// Scanner of the numbers of a .msh file, text or binary.
#pragma once

#include <deal.II/base/point.h>

#include <mortise/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <sstream>
#include <string>

#include "mesh_file_parts.h"

namespace mortise
{
  /// Fails at the end of the file; never knows what a section holds.
  class MshScanner
  {
  public:
    MshScanner(const std::string &content, const FileError &file_error)
      : content(content)
      , file_error(file_error)
    {}

    [[noreturn]] void
    fail(const std::string &what) const
    {
      const auto lines =
        1 + std::count(content.begin(), content.begin() + at, '\n');
      file_error("is not a complete mesh: in $" + section + ", " +
                 (binary ? "byte " + std::to_string(at) :
                           "line " + std::to_string(lines)) +
                 ", " + what);
      std::abort(); // file_error throws
    }

    [[noreturn]] void
    fail_at_end(const std::string &missing) const
    {
      file_error("ends before $End" + missing + "; allowed: a complete file");
      std::abort(); // file_error throws
    }

    int
    integer()
    {
      if (binary)
        return bytes<int>();
      const long long number = text_integer();
      if (number < std::numeric_limits<int>::min() ||
          number > std::numeric_limits<int>::max())
        fail("there is the number " + std::to_string(number) +
             "; allowed: at most 2147483647 in magnitude");
      return static_cast<int>(number);
    }

    /// A number of things or a tag: size_t in version 4.1.
    std::uint64_t
    count()
    {
      return binary ? bytes<std::uint64_t>() : text_count();
    }

    /// The tag of a node in version 2.2, where it is an int.
    std::uint64_t
    tag()
    {
      const int number = integer();
      if (number < 1)
        fail("a node has the tag " + std::to_string(number) +
             "; allowed: 1 and more");
      return number;
    }

    /// A count in plain text, whatever the format.
    std::uint64_t
    line_count()
    {
      const std::uint64_t n = text_count();
      if (binary && at < content.size() && content[at] == '\n')
        ++at;
      return n;
    }

    /// A text in double quotes, whatever the format.
    std::string
    quoted()
    {
      const std::size_t begin = content.find_first_not_of(" \t", at);
      if (begin == std::string::npos || content[begin] != '"')
        fail("there is no name in double quotes");
      const std::size_t end = content.find_first_of("\"\r\n", begin + 1);
      if (end == std::string::npos || content[end] != '"')
        fail("the double quotes around a name do not end");
      at = end + 1;
      return content.substr(begin + 1, end - begin - 1);
    }

    /// A number in plain text, whatever the format.
    int
    line_integer()
    {
      const bool bytes = binary;
      binary           = false;
      const int number = integer();
      binary           = bytes;
      return number;
    }

    void
    skip_reals(const unsigned int n)
    {
      for (unsigned int i = 0; i < n; ++i)
        if (binary)
          bytes<double>();
        else
          text_real();
    }

    /// The coordinates of the node @p tag.
    dealii::Point<3>
    coordinates(const std::int64_t tag)
    {
      dealii::Point<3> place;
      for (unsigned int d = 0; d < 3; ++d)
        {
          const double x = binary ? bytes<double>() : text_real();
          place[d]       = x;
          if (std::fabs(x) <= largest_length)
            continue;
          std::ostringstream what;
          what << "has the coordinate "
               << "xyz"[d] << " = " << x << " of node " << tag
               << (std::isfinite(x) ? "" : ", which is not finite")
               << "; allowed: finite numbers of at most " << largest_length
               << " in magnitude";
          file_error(what.str());
        }
      return place;
    }

    std::vector<int>
    integers(const std::uint64_t n)
    {
      fits(n, 4, "integers");
      std::vector<int> result;
      for (std::uint64_t i = 0; i < n; ++i)
        result.push_back(integer());
      return result;
    }

    /// @p n things of so many bytes each, or (as text) of two at least.
    void
    fits(const std::uint64_t n, const unsigned int size, const char *what)
    {
      if (n > (content.size() - at) / (binary ? size : 2))
        fail("there are said to be " + std::to_string(n) + " " + what +
             ", more than the rest of the file can hold");
    }

    /// To the line after "$End" + section.
    void
    end_section(const bool here)
    {
      const std::size_t end = content.find("$End" + section, at);
      if (end == std::string::npos)
        fail_at_end(section);
      if (here && content.find_first_not_of(" \t\r\n", at) != end)
        fail("there is something else before $End" + section);
      at = end + 4 + section.size();
    }

    /// Name of the next section; false at the end of the file.
    bool
    next_section()
    {
      at = content.find('$', at);
      if (at == std::string::npos)
        return false;
      const std::size_t end = content.find_first_of("\r\n", at);
      if (end == std::string::npos)
        return false;
      section = content.substr(at + 1, end - at - 1);
      section.erase(section.find_last_not_of(" \t") + 1);
      at = content.find('\n', end) + 1;
      return at != 0;
    }

    std::string section = "MeshFormat";
    bool        binary  = false;

  private:
    const std::string &content;
    const FileError   &file_error;
    std::size_t        at = 0;

    template <typename Number>
    Number
    bytes()
    {
      Number number;
      if (content.size() - at < sizeof(Number))
        fail("the file ends");
      std::memcpy(&number, &content[at], sizeof(Number));
      at += sizeof(Number);
      return number;
    }

    long long
    text_integer()
    {
      char           *end;
      const long long number = std::strtoll(&content[at], &end, 10);
      finish_text(end);
      return number;
    }

    std::uint64_t
    text_count()
    {
      const long long number = text_integer();
      if (number < 0)
        fail("there is the number " + std::to_string(number) +
             " where things are counted; allowed: 0 and more");
      return static_cast<std::uint64_t>(number);
    }

    double
    text_real()
    {
      char        *end;
      const double number = std::strtod(&content[at], &end);
      finish_text(end);
      return number;
    }

    void
    finish_text(const char *end)
    {
      if (end == &content[at])
        fail("there is no number");
      at = end - content.data();
    }
  };
} // namespace mortise
