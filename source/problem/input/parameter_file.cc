#include <mortise/base/error.h>
#include <mortise/base/quotes.h>
#include <mortise/problem/input/parameter_file.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace mortise
{

  std::string
  normalised(const std::string &text)
  {
    std::istringstream words(text);
    std::string        result, word;
    while (words >> word)
      result += (result.empty() ? "" : " ") + word;
    return result;
  }

  std::vector<std::string>
  split_outside_parentheses(const std::string &text, const char separator)
  {
    if (normalised(text).empty())
      return {};
    std::vector<std::string> parts(1);
    int                      depth = 0;
    for (const char c : text)
      {
        depth += (c == '(') - (c == ')');
        if (c == separator && depth == 0)
          parts.emplace_back();
        else
          parts.back() += c;
      }
    for (std::string &part : parts)
      part = normalised(part);
    if (parts.size() > 1 && parts.back().empty())
      parts.pop_back();
    return parts;
  }

  std::string
  did_you_mean(const std::string &got, const std::vector<std::string> &allowed)
  {
    const std::string nearest = nearest_name(got, allowed);
    return nearest.empty() ? "" : " (did you mean " + in_quotes(nearest) + "?)";
  }

  std::string
  read_text_file(const std::string &file, const std::string &from)
  {
    const std::string what =
      "parameter file " + file_in_quotes(file) + from + ": ";
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored))
      throw InputError(what +
                       "this is a directory; the name of a file is needed");
    errno = 0;
    std::ifstream stream(file);
    if (!stream)
      {
        const std::filesystem::path path(file);
        std::vector<std::string>    beside;
        const auto                  directory =
          path.has_parent_path() ? path.parent_path() : ".";
        for (const auto &entry :
             std::filesystem::directory_iterator(directory, ignored))
          if (entry.path().extension() == ".prm")
            beside.push_back(entry.path().filename().string());
        std::sort(beside.begin(), beside.end());
        throw InputError(what + "cannot be read: " +
                         std::strerror(errno == 0 ? ENOENT : errno) +
                         did_you_mean(path.filename().string(), beside));
      }
    std::ostringstream text;
    text << stream.rdbuf();
    if (stream.bad())
      throw InputError(what + "cannot be read to its end");
    return text.str();
  }

  namespace
  {
    /// A line joined from continued ones.
    struct Line
    {
      std::string text; ///< without comment, normalised
      std::string origin;
    };

    std::vector<Line>
    lines_of(const std::string &text, const std::string &file)
    {
      std::istringstream stream(text);
      std::vector<Line>  lines;
      std::string        raw, joined;
      std::size_t        number = 0, first = 0;
      bool               continued = false;
      while (std::getline(stream, raw))
        {
          ++number;
          if (!continued)
            first = number;
          raw.erase(std::min(raw.find('#'), raw.size()));
          raw.erase(raw.find_last_not_of(" \t\r") + 1);
          continued = !raw.empty() && raw.back() == '\\';
          if (continued)
            raw.pop_back();
          joined += raw;
          if (continued)
            continue;
          if (!normalised(joined).empty())
            lines.push_back({normalised(joined),
                             "line " + std::to_string(first) + " of " + file});
          joined.clear();
        }
      if (continued)
        throw InputError(
          "line " + std::to_string(number) + " of " + file +
          ": the file ends with \\, which continues a line; got no next line");
      return lines;
    }

    /// Names stand in messages as they are.
    void
    check_length(const std::string &name, const std::string &origin)
    {
      constexpr std::size_t longest = 200;
      if (name.size() > longest)
        throw InputError(origin + ": got the name " + in_quotes(name) +
                         "; allowed: names of at most " +
                         std::to_string(longest) + " characters");
    }

    /// Collects the assignments of a file and of those that it includes.
    class Scanner
    {
    public:
      void
      scan(const std::string &text, const std::string &file)
      {
        const std::size_t depth = sections.size();
        for (const Line &line : lines_of(text, file))
          scan_line(line, file, depth);
        if (sections.size() > depth)
          throw InputError("subsection " + in_quotes(sections.back()) + " (" +
                           opened_at.back() +
                           "): \"end\" is missing before the end of " + file);
      }

      std::vector<Assignment> assignments;

    private:
      void
      scan_line(const Line        &line,
                const std::string &file,
                const std::size_t  depth)
      {
        std::string keyword = line.text.substr(0, line.text.find(' '));
        std::transform(keyword.begin(),
                       keyword.end(),
                       keyword.begin(),
                       [](unsigned char c) { return std::tolower(c); });
        const std::string rest = normalised(line.text.substr(keyword.size()));
        if (keyword == "set")
          scan_set(line, rest);
        else if (keyword == "subsection")
          open(line, rest);
        else if (keyword == "end" && rest.empty())
          {
            if (sections.size() == depth)
              throw InputError(line.origin +
                               ": \"end\" without an open subsection");
            sections.pop_back();
            opened_at.pop_back();
          }
        else if (keyword == "include")
          include(line, rest, file);
        else
          throw InputError(
            line.origin + ": cannot understand " + in_quotes(line.text) +
            "; allowed are: set NAME = VALUE, subsection NAME, end, include FILE, "
            "and comments after #" +
            did_you_mean(keyword, {"set", "subsection", "end", "include"}));
      }

      void
      scan_set(const Line &line, const std::string &rest)
      {
        const std::size_t equals = rest.find('=');
        const std::string name   = normalised(rest.substr(0, equals));
        if (equals == std::string::npos || name.empty())
          throw InputError(line.origin + ": cannot understand " +
                           in_quotes(line.text) +
                           "; allowed is: set NAME = VALUE");
        check_length(name, line.origin);
        assignments.push_back(
          {sections, name, normalised(rest.substr(equals + 1)), line.origin});
      }

      void
      open(const Line &line, const std::string &name)
      {
        if (name.empty())
          throw InputError(
            line.origin +
            ": a subsection needs a name, as in \"subsection Solver\"");
        check_length(name, line.origin);
        constexpr std::size_t deepest = 20;
        if (sections.size() == deepest)
          throw InputError(line.origin + ": subsections are nested more than " +
                           std::to_string(deepest) +
                           " deep; is an \"end\" missing?");
        sections.push_back(name);
        opened_at.push_back(line.origin);
        assignments.push_back({sections, "", "", line.origin});
      }

      void
      include(const Line        &line,
              const std::string &name,
              const std::string &file)
      {
        constexpr unsigned int deepest = 20;
        const std::string      from    = " (included at " + line.origin + ")";
        if (name.empty())
          throw InputError(line.origin + ": include needs the name of a file");
        if (++nesting > deepest)
          throw InputError(
            "parameter file " + file_in_quotes(name) + from +
            ": more than 20 files within each other; does one include itself?");
        const auto beside = std::filesystem::path(file).parent_path() / name;
        std::error_code   ignored;
        const bool        found = std::filesystem::exists(beside, ignored);
        const std::string path  = found ? beside.string() : name;
        scan(read_text_file(path, from), path);
        --nesting;
      }

      std::vector<std::string> sections, opened_at;
      unsigned int             nesting = 0;
    };
  } // namespace

  std::vector<Assignment>
  scan_parameter_text(const std::string &text, const std::string &file)
  {
    Scanner scanner;
    scanner.scan(text, file);
    return scanner.assignments;
  }

  Assignment
  scan_setting(const std::string &setting)
  {
    const std::string        origin = "--set " + in_quotes(setting);
    const std::size_t        equals = setting.find('=');
    std::vector<std::string> path;
    std::istringstream       stream(setting.substr(0, equals));
    for (std::string part; std::getline(stream, part, '/');)
      path.push_back(normalised(part));
    const bool empty_part =
      std::any_of(path.begin(), path.end(), [](const std::string &part) {
        return part.empty();
      });
    if (equals == std::string::npos || path.empty() || empty_part)
      throw InputError(
        origin +
        ": cannot understand this; allowed is SECTION/SUBSECTION/NAME=VALUE, "
        "for example --set \"Body inner/Mesh/Refinements=1\"");
    for (const std::string &part : path)
      check_length(part, origin);
    const std::string name = path.back();
    path.pop_back();
    return {path, name, normalised(setting.substr(equals + 1)), origin};
  }
} // namespace mortise
