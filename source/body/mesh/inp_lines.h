// Lines of an input file of Abaqus or CalculiX.
#pragma once

#include <deal.II/base/utilities.h>

#include <mortise/base/numbers.h>
#include <mortise/base/quotes.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "mesh_file_parts.h"

namespace mortise
{
  inline std::string
  upper(std::string text)
  {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) {
      return std::toupper(c);
    });
    return text;
  }


  class InpLines
  {
  public:
    InpLines(const std::string &content, const FileError &fail)
      : in(content)
      , fail_file(fail)
    {}

    [[noreturn]] void
    fail(const std::string &what) const
    {
      fail_file("has in line " + std::to_string(number) + " " + what);
      std::abort();
    }

    /// The next line that is no comment, without blanks around it.
    bool
    next_line()
    {
      while (std::getline(in, line))
        {
          ++number;
          line = dealii::Utilities::trim(line);
          if (!line.empty() && line.back() == '\r')
            line.pop_back();
          if (!line.empty() && line.compare(0, 2, "**") != 0)
            return true;
        }
      return false;
    }

    static std::vector<std::string>
    words_of(const std::string &text)
    {
      std::vector<std::string> words;
      std::istringstream       parts(text);
      for (std::string part; std::getline(parts, part, ',');)
        words.push_back(dealii::Utilities::trim(part));
      while (!words.empty() && words.back().empty())
        words.pop_back();
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
      std::string text = word;
      for (char &c : text)
        if (c == 'd' || c == 'D') // of Fortran
          c = 'e';
      const ReadNumber value = read_number(text);
      if (!value.problem.empty() || !std::isfinite(value.value))
        fail(in_quotes(word, '\'') + ", which is no number");
      return value.value;
    }

    std::optional<long>
    integer_if_any(const std::string &word) const
    {
      char      *end   = nullptr;
      const long value = std::strtol(word.c_str(), &end, 10);
      if (word.empty() || *end != '\0')
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
    std::istringstream in;
    const FileError   &fail_file;
    std::size_t        number = 0;
  };
} // namespace mortise
