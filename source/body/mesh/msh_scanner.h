// The numbers of a .msh file one by one, as text or as bytes. It never knows
// what a section holds.
#pragma once

#include <mortise/base/numbers.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <string>

#include "mesh_file_parts.h"

namespace mortise
{
  /// Reads numbers one by one, as text or as bytes, and fails at the end of
  /// the file.
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
      file_error("is not a complete mesh: in $" + section + ", byte " +
                 std::to_string(at) + ", " + what);
      std::abort(); // file_error throws
    }

    int
    integer()
    {
      return binary ? bytes<int>() : static_cast<int>(text_integer());
    }

    /// A number of things or a tag: size_t in version 4.1.
    std::uint64_t
    count()
    {
      return binary ? bytes<std::uint64_t>() :
                      static_cast<std::uint64_t>(text_integer());
    }

    /// A count in plain text, whatever the format.
    std::uint64_t
    line_count()
    {
      const std::uint64_t n = text_integer();
      if (binary && at < content.size() && content[at] == '\n')
        ++at;
      return n;
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
    void
    coordinates(const std::int64_t tag)
    {
      for (unsigned int d = 0; d < 3; ++d)
        {
          const double x = binary ? bytes<double>() : text_real();
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
    }

    void
    skip_integers(const std::uint64_t n)
    {
      fits(n, 4, "integers");
      for (std::uint64_t i = 0; i < n; ++i)
        integer();
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
        file_error("ends before $End" + section + "; allowed: a complete file");
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
