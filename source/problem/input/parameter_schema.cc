#include <mortise/base/error.h>
#include <mortise/base/quotes.h>
#include <mortise/problem/input/parameter_schema.h>

#include <algorithm>
#include <sstream>

namespace mortise
{
  namespace
  {
    using Strings = std::vector<std::string>;

    bool
    starts_with(const std::string &text, const std::string &start)
    {
      return text.compare(0, start.size(), start) == 0;
    }
    /// Subsections that stand in @p parent, in order.
    Strings
    subsections(const std::vector<ParameterEntry> &entries,
                const Strings                     &parent)
    {
      Strings known;
      for (const ParameterEntry &entry : entries)
        if (entry.sections.size() > parent.size() &&
            std::equal(parent.begin(), parent.end(), entry.sections.begin()) &&
            std::find(known.begin(),
                      known.end(),
                      entry.sections[parent.size()]) == known.end())
          known.push_back(entry.sections[parent.size()]);
      return known;
    }

    /// Why there is no subsection "Body NAME" among the @p known ones, @p what being "body" and
    /// @p list "Bodies"; empty for other subsections.
    std::string
    not_named(const std::string &section,
              const Strings     &known,
              const std::string &start,
              const std::string &list)
    {
      if (!starts_with(section, start))
        return "";
      Strings names;
      for (const std::string &name : known)
        if (starts_with(name, start))
          names.push_back(name.substr(start.size()));
      const std::string what = start == "Body " ? "body" : "interface";
      return ": \"set " + list + " = " + join_names(names) +
             "\" does not name this " + what;
    }

    void
    check_sections(const std::vector<ParameterEntry> &entries,
                   const Assignment                  &assignment)
    {
      Strings parent;
      for (const std::string &section : assignment.sections)
        {
          Strings known = subsections(entries, parent);
          if (std::find(known.begin(), known.end(), section) == known.end())
            {
              Strings     near = known;
              std::string why;
              if (parent.empty())
                why = not_named(section, known, "Body ", "Bodies") +
                      not_named(section, known, "Interface ", "Interfaces");
              else if (parent.size() == 1 && starts_with(parent[0], "Body "))
                {
                  known.push_back("Boundary NAME");
                  near.push_back("Boundary" +
                                 section.substr(std::min(section.find(' '),
                                                         section.size())));
                }
              throw InputError(
                "unknown subsection " + in_quotes(section) +
                (parent.empty() ? "" : " in " + in_quotes(path_of(parent))) +
                " (" + assignment.origin + ")" + why +
                did_you_mean(section, near) +
                "; allowed here: " + join_names(known));
            }
          parent.push_back(section);
        }
    }

    ParameterEntry &
    find(std::vector<ParameterEntry> &entries, const Assignment &assignment)
    {
      Strings here, elsewhere;
      for (ParameterEntry &entry : entries)
        {
          if (entry.sections == assignment.sections &&
              entry.name == assignment.name)
            return entry;
          if (entry.sections == assignment.sections)
            here.push_back(entry.name);
          else if (entry.name == assignment.name)
            elsewhere.push_back(path_of(entry.sections));
        }
      std::string   hint  = did_you_mean(assignment.name, here);
      const Strings below = subsections(entries, assignment.sections);
      if (std::find(below.begin(), below.end(), assignment.name) != below.end())
        hint = " (it is a subsection)";
      else if (!elsewhere.empty())
        hint = " (it belongs into: " + join_names(elsewhere) + ")";
      throw InputError("unknown parameter " + in_quotes(assignment.name) +
                       (assignment.sections.empty() ?
                          "" :
                          " in " + in_quotes(path_of(assignment.sections))) +
                       " (" + assignment.origin + ")" + hint +
                       "; allowed here: " + join_names(here));
    }

    /// @p text in comment lines of at most 100 characters.
    std::string
    comment(const std::string &text, const std::string &indent)
    {
      constexpr std::size_t width = 98;
      std::istringstream    words(text);
      std::string           result, line = indent + "#", word;
      while (words >> word)
        {
          if (line.size() + 1 + word.size() > width)
            {
              result += line + "\n";
              line = indent + "#";
            }
          line += " " + word;
        }
      return result + line + "\n";
    }

    const char *const reference_heading =
      "# Every parameter with its default, unit, meaning and what is allowed. This is a parameter\n"
      "# file itself. NAME stands for a name that the file chooses: a body, one of its\n"
      "# boundaries, or an interface. Units are those of the scene: any that fit together, such "
      "as\n"
      "# m, N, Pa or mm, N, MPa. Expressions know x, y, z, pi, + - * / ^, comparisons,\n"
      "# if(condition, then, else), and sin, cos, tan, asin, acos, atan, atan2, sinh, cosh, tanh,\n"
      "# exp, log, sqrt, abs, min, max, pow. On the command line:\n"
      "#   mortise --set \"Body NAME/Mesh/Source=box\" FILE.prm\n";
  } // namespace

  void
  assign(std::vector<ParameterEntry> &entries,
         const Assignment            &assignment,
         const std::string           &where)
  {
    check_sections(entries, assignment);
    if (assignment.opens_section())
      return;
    ParameterEntry &entry = find(entries, assignment);
    entry.value           = assignment.value;
    entry.where           = where;
  }

  std::vector<ParameterEntry>
  entries_of_reference()
  {
    // the functions that set members are never called
    Parameters parameters;
    parameters.bodies.resize(1);
    parameters.bodies[0].name = "NAME";
    parameters.bodies[0].boundaries["NAME"];
    parameters.interfaces.resize(1);
    parameters.interfaces[0].name = "NAME";
    return declare_parameters(parameters);
  }

  std::string
  parameter_reference()
  {
    std::string text = reference_heading;
    Strings     open;
    const auto  indent = [&open] { return std::string(2 * open.size(), ' '); };
    const auto  close  = [&] {
      open.pop_back();
      text += indent() + "end\n";
    };
    for (const ParameterEntry &entry : entries_of_reference())
      {
        while (open.size() > entry.sections.size() ||
               !std::equal(open.begin(), open.end(), entry.sections.begin()))
          close();
        while (open.size() < entry.sections.size())
          {
            const std::string section = entry.sections[open.size()];
            text += "\n" + indent() + "subsection " + section + "\n";
            open.push_back(section);
          }
        text += "\n" + comment(entry.meaning.text, indent()) +
                comment("Allowed: " + entry.allowed.words + ".", indent()) +
                indent() + "set " + entry.name + " =" +
                (entry.default_value.empty() ? "" : " " + entry.default_value) +
                "\n";
      }
    while (!open.empty())
      close();
    return text;
  }
} // namespace mortise
