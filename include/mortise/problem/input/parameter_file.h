// Lines of a parameter file in the syntax of dealii::ParameterHandler, with
// their origins for messages.
#pragma once

#include <string>
#include <vector>

namespace mortise
{
  /// "Body inner/Mesh/Source"
  inline std::string
  path_of(const std::vector<std::string> &sections,
          const std::string              &name = "")
  {
    std::string path;
    for (const std::string &section : sections)
      path += (path.empty() ? "" : "/") + section;
    return path + (path.empty() || name.empty() ? "" : "/") + name;
  }

  /// "set name = value" within nested subsections, or the opening of a
  /// subsection (no name).
  struct Assignment
  {
    std::vector<std::string> sections;
    std::string              name;
    std::string              value;
    std::string              origin; ///< "line 7 of scene.prm", "--set ..."

    bool
    opens_section() const
    {
      return name.empty();
    }

    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &sections &name &value &origin;
    }
  };

  /// Lines of @p text: comments (#) and continuations (\ at the end of a line) are understood,
  /// and "include FILE" takes another file, sought beside the including one,
  /// then in the current directory. Throws InputError with the line.
  std::vector<Assignment>
  scan_parameter_text(const std::string &text, const std::string &file);

  /// "Section/Subsection/Name=value" of the command line. Throws InputError.
  Assignment
  scan_setting(const std::string &setting);

  /// The text of @p file. Throws InputError if it is missing, a directory, or
  /// unreadable. @p from: "" or " (included at line 3 of scene.prm)", for
  /// messages.
  std::string
  read_text_file(const std::string &file, const std::string &from = "");

  /// @p text without blanks at both ends and with single blanks within.
  std::string
  normalised(const std::string &text);

  /// Parts of @p text between @p separator outside of parentheses, normalised; none for an empty
  /// text. An empty part at the very end ("a; b;") is dropped.
  std::vector<std::string>
  split_outside_parentheses(const std::string &text, char separator);

  /// " (did you mean "X"?)" or "", with the entry of @p allowed nearest to @p got.
  std::string
  did_you_mean(const std::string &got, const std::vector<std::string> &allowed);
} // namespace mortise
