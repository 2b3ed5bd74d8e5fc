#include <mortise/base/error.h>
#include <mortise/base/quotes.h>
#include <mortise/problem/parameter_schema.h>

#include <algorithm>
#include <sstream>

namespace mortise
{
  namespace
  {
    std::string
    path_of(const std::vector<std::string> &sections)
    {
      std::string path;
      for (const std::string &section : sections)
        path += (path.empty() ? "" : "/") + section;
      return path;
    }

    bool
    starts_with(const std::string &text, const std::string &start)
    {
      return text.compare(0, start.size(), start) == 0;
    }
  } // namespace

  ParameterSchema::ParameterSchema(const SceneNames &names)
    : names(names)
    , declared(declare_parameters(names))
  {
    for (const ParameterDeclaration &p : declared)
      {
        for (const std::string &section : p.sections)
          handler.enter_subsection(section);
        handler.declare_entry(p.name, p.default_value, *p.pattern, p.meaning);
        for (unsigned int i = 0; i < p.sections.size(); ++i)
          handler.leave_subsection();
      }
  }

  void
  ParameterSchema::check_sections(const Assignment &assignment) const
  {
    std::vector<std::string> parent;
    for (const std::string &section : assignment.sections)
      {
        std::vector<std::string> known; // subsections of the parent, in order
        for (const ParameterDeclaration &p : declared)
          if (p.sections.size() > parent.size() &&
              std::equal(parent.begin(), parent.end(), p.sections.begin()) &&
              std::find(known.begin(),
                        known.end(),
                        p.sections[parent.size()]) == known.end())
            known.push_back(p.sections[parent.size()]);
        if (std::find(known.begin(), known.end(), section) == known.end())
          {
            std::vector<std::string> near = known;
            if (parent.size() == 1 && starts_with(parent[0], "Body "))
              {
                known.push_back("Boundary NAME");
                near.push_back(
                  "Boundary" +
                  section.substr(std::min(section.find(' '), section.size())));
              }
            std::string why;
            if (parent.empty() && starts_with(section, "Body "))
              why = ": \"set Bodies = " + join_names(names.bodies) +
                    "\" does not name this body";
            else if (parent.empty() && starts_with(section, "Interface "))
              why = ": \"set Interfaces = " + join_names(names.interfaces) +
                    "\" does not name this interface";
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

  const ParameterDeclaration &
  ParameterSchema::find(const Assignment &assignment) const
  {
    std::vector<std::string> here, elsewhere;
    for (const ParameterDeclaration &p : declared)
      {
        if (p.sections == assignment.sections && p.name == assignment.name)
          return p;
        if (p.sections == assignment.sections)
          here.push_back(p.name);
        else if (p.name == assignment.name)
          elsewhere.push_back(path_of(p.sections));
      }
    std::string              hint   = did_you_mean(assignment.name, here);
    std::vector<std::string> itself = assignment.sections;
    itself.push_back(assignment.name);
    const bool is_section =
      std::any_of(declared.begin(), declared.end(), [&](const auto &p) {
        return p.sections.size() >= itself.size() &&
               std::equal(itself.begin(), itself.end(), p.sections.begin());
      });
    if (is_section)
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

  void
  ParameterSchema::assign(const Assignment &assignment)
  {
    check_sections(assignment);
    if (assignment.opens_section())
      return;
    const ParameterDeclaration &p = find(assignment);
    if (!p.pattern->match(assignment.value))
      throw InputError(
        path_of(p.sections) + (p.sections.empty() ? "" : "/") + p.name + " (" +
        assignment.origin + "): got " + in_quotes(assignment.value) +
        did_you_mean(assignment.value, p.choices) + "; allowed: " + p.allowed);
    for (const std::string &section : p.sections)
      handler.enter_subsection(section);
    handler.set(p.name, assignment.value);
    for (unsigned int i = 0; i < p.sections.size(); ++i)
      handler.leave_subsection();
  }

  std::string
  ParameterSchema::get(const std::vector<std::string> &sections,
                       const std::string              &name) const
  {
    return handler.get(sections, name);
  }

  const std::vector<ParameterDeclaration> &
  ParameterSchema::declarations() const
  {
    return declared;
  }

  namespace
  {
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

  std::string
  parameter_reference()
  {
    std::string              text = reference_heading;
    std::vector<std::string> open;
    const auto indent = [&open] { return std::string(2 * open.size(), ' '); };
    const auto close  = [&] {
      open.pop_back();
      text += indent() + "end\n";
    };
    for (const ParameterDeclaration &p :
         declare_parameters({{"NAME"}, {{"NAME"}}, {"NAME"}}))
      {
        while (open.size() > p.sections.size() ||
               !std::equal(open.begin(), open.end(), p.sections.begin()))
          close();
        while (open.size() < p.sections.size())
          {
            const std::string section = p.sections[open.size()];
            text += "\n" + indent() + "subsection " + section + "\n";
            open.push_back(section);
          }
        const bool names =
          p.sections.empty() && (p.name == "Bodies" || p.name == "Interfaces");
        const std::string value = names ? "NAME" : p.default_value;
        text += "\n" + comment(p.meaning, indent()) +
                comment("Allowed: " + p.allowed + ".", indent()) + indent() +
                "set " + p.name + " =" + (value.empty() ? "" : " " + value) +
                "\n";
      }
    while (!open.empty())
      close();
    return text;
  }
} // namespace mortise
