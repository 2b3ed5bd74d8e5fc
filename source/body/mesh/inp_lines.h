// Lines of an input file of Abaqus or CalculiX, and of those that it includes.
#pragma once

#include <deal.II/base/utilities.h>

#include <mortise/base/quotes.h>
#include <mortise/body/mesh/inp_deck.h>

#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "mesh_file_parts.h"

namespace mortise
{
  class InpLines
  {
  public:
    InpLines(const std::string &file, const FileError &fail)
      : fail_file(fail)
      , directory(std::filesystem::path(file).parent_path())
    {
      sources.emplace_back();
      sources.back().in.str(content_of(file, fail));
    }

    /// "line 12", or "line 3 of 'mesh.inc'".
    std::string
    place() const
    {
      std::string text = "line " + std::to_string(sources.back().number);
      if (sources.size() > 1)
        text += " of " + file_in_quotes(sources.back().name, '\'');
      return text;
    }

    [[noreturn]] void
    fail(const std::string &what) const
    {
      fail_file("has in " + place() + " " + what);
      std::abort();
    }

    /// The next line that is no comment, without blanks around it.
    bool
    next_line()
    {
      for (; !sources.empty(); sources.pop_back())
        {
          while (std::getline(sources.back().in, line))
            {
              ++sources.back().number;
              line = dealii::Utilities::trim(line);
              if (!line.empty() && line.back() == '\r')
                line.pop_back();
              if (!line.empty() && line.compare(0, 2, "**") != 0)
                return true;
            }
          if (sources.size() == 1)
            break; // place() may still be asked for
        }
      return false;
    }

    /// Lines of the file @p name come next.
    void
    include(const std::string &name)
    {
      if (sources.size() > 16)
        fail("an *INCLUDE within 16 others; does a file include itself?");
      const std::string content = content_of(
        located_file(name, directory.string()), [&](const std::string &what) {
          fail("*INCLUDE of " + file_in_quotes(name, '\'') + ", which " + what);
        });
      sources.emplace_back();
      sources.back().name = name;
      sources.back().in.str(content);
    }

    /// At least one, which may be empty.
    static std::vector<std::string>
    words_of(const std::string &text)
    {
      std::vector<std::string> words;
      std::istringstream       parts(text);
      for (std::string part; std::getline(parts, part, ',');)
        words.push_back(dealii::Utilities::trim(part));
      while (words.size() > 1 && words.back().empty())
        words.pop_back();
      if (words.empty())
        words.emplace_back();
      return words;
    }

    /// The keyword of a line that begins with '*', in capitals; its options.
    std::string
    read_keyword()
    {
      std::string text = line;
      while (text.back() == ',' && next_line())
        text += line;
      options.clear();
      const auto words = words_of(text);
      for (std::size_t i = 1; i < words.size(); ++i)
        {
          const std::size_t equals = words[i].find('=');
          std::string       value =
            equals == std::string::npos ?
                    "" :
                    dealii::Utilities::trim(words[i].substr(equals + 1));
          if (value.size() > 1 && value.front() == '"')
            value = value.substr(1, value.size() - 2);
          options[upper(dealii::Utilities::trim(words[i].substr(0, equals)))] =
            value;
        }
      return upper(words[0]);
    }

    double
    real(const std::string &word) const
    {
      return inp_number(word, [&](const std::string &what) { fail(what); });
    }

    static std::optional<long>
    integer_if_any(const std::string &word)
    {
      long        value = 0; // differences of two are numbers, too
      const char *end   = word.c_str() + word.size();
      if (const auto read = std::from_chars(word.c_str(), end, value);
          read.ec != std::errc() || read.ptr != end ||
          std::abs(value) > std::numeric_limits<long>::max() / 2)
        return {};
      return value;
    }

    long
    integer(const std::string &word) const
    {
      const auto value = integer_if_any(word);
      if (!value)
        fail(in_quotes(word, '\'') + ", which is no integer");
      return *value;
    }

    std::string                        line;
    std::map<std::string, std::string> options; ///< of the last keyword

  private:
    struct Source
    {
      std::istringstream in;
      std::string        name;
      std::size_t        number = 0;
    };

    const FileError            &fail_file;
    const std::filesystem::path directory;
    std::vector<Source>         sources; ///< the file, what it includes, ...
  };
} // namespace mortise
