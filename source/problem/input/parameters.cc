#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <mortise/base/error.h>
#include <mortise/base/quotes.h>
#include <mortise/problem/input/formulation.h>
#include <mortise/problem/input/parameter_schema.h>
#include <mortise/problem/input/parameters.h>

#include <algorithm>
#include <filesystem>

#include "parameter_checks.h"

namespace mortise
{

  std::string
  Parameters::where(const std::string &path) const
  {
    auto origin = origins.find(path);
    if (origin != origins.end())
      return path + " (" + origin->second + ")";
    // a subsection that only --set opens: its first parameter
    origin = origins.lower_bound(path + "/");
    const bool within =
      origin != origins.end() &&
      origin->first.compare(0, path.size() + 1, path + "/") == 0;
    return within ? path + " (" + origin->second + ")" : path;
  }

  void
  Parameters::fail(const std::string &path,
                   const std::string &got,
                   const std::string &allowed) const
  {
    throw InputError(where(path) + ": got " + got + "; allowed: " + allowed);
  }

  const std::vector<std::string> &
  field_names()
  {
    static const std::vector<std::string> names = {"displacement",
                                                   "stress",
                                                   "pressure",
                                                   "plastic_strain",
                                                   "deformation_gradient",
                                                   "traction",
                                                   "degree",
                                                   "estimate"};
    return names;
  }

  namespace
  {
    using Strings = std::vector<std::string>;

    /// Names in "set Bodies = ..." or "set Interfaces = ...": the first pass
    /// over the file.
    Strings
    read_names(const std::vector<Assignment> &assignments,
               const std::string             &parameter)
    {
      Strings     names;
      std::string origin;
      for (const Assignment &a : assignments)
        if (a.sections.empty() && a.name == parameter)
          {
            names  = split_outside_parentheses(a.value, ',');
            origin = parameter + " (" + a.origin + "): ";
          }
      for (const std::string &name : names)
        {
          // names are those of files, and stand in those that gather them
          if (name.empty() || name == "." || name == ".." ||
              name.find_first_of(":;/\\<>&\"'") != std::string::npos ||
              std::any_of(name.begin(), name.end(), [](unsigned char c) {
                return std::iscntrl(c);
              }))
            throw InputError(
              origin + "got the name " + in_quotes(name) +
              "; a name is not empty, no . or .., and contains none of : ; / \\ < > & \" ' "
              "and no control characters");
          if (name.size() > 100)
            throw InputError(origin + "got the name " + in_quotes(name) +
                             "; a name has at most 100 characters");
          if (std::count(names.begin(), names.end(), name) > 1)
            throw InputError(origin + "the name " + in_quotes(name) +
                             " stands there twice; each name only once");
        }
      return names;
    }

    /// The bodies, their boundaries and the interfaces that the file and --set
    /// name, with all else at its default.
    Parameters
    named_scene(const std::vector<Assignment> &assignments,
                const std::string             &file)
    {
      Parameters parameters;
      parameters.file      = file;
      const Strings bodies = read_names(assignments, "Bodies");
      if (bodies.empty())
        throw InputError(
          "Bodies (" + file +
          "): got no name of a body; needed is at least one, as in \"set Bodies = "
          "block\", with a subsection \"Body block\"");
      const std::string prefix = "Boundary ";
      for (const std::string &name : bodies)
        {
          BodyParameters &body = parameters.bodies.emplace_back();
          body.name            = name;
          body.mesh.directory =
            std::filesystem::path(file).parent_path().string();
          for (const Assignment &a : assignments)
            if (a.sections.size() > 1 && a.sections[0] == "Body " + name &&
                a.sections[1].compare(0, prefix.size(), prefix) == 0)
              body.boundaries[a.sections[1].substr(prefix.size())];
        }
      for (const std::string &name : read_names(assignments, "Interfaces"))
        parameters.interfaces.emplace_back().name = name;
      return parameters;
    }

    std::vector<Assignment>
    collect(const std::string &text,
            const std::string &file,
            const Settings    &settings)
    {
      std::vector<Assignment> assignments = scan_parameter_text(text, file);
      for (const std::string &setting : settings)
        assignments.push_back(scan_setting(setting));
      return assignments;
    }
  } // namespace

  Parameters
  parse_parameters(const std::vector<Assignment> &assignments,
                   const std::string             &file)
  {
    Parameters                  parameters = named_scene(assignments, file);
    std::vector<ParameterEntry> entries    = declare_parameters(parameters);
    for (const Assignment &assignment : assignments)
      {
        const std::string path = path_of(assignment.sections, assignment.name);
        parameters.origins[path] = assignment.origin;
        assign(entries, assignment, parameters.where(path));
      }
    for (const ParameterEntry &entry : entries)
      entry.set({entry.value, entry.where, entry.allowed});
    add_supports(parameters);
    choose_sliding(parameters);
    // cycles find degrees, those that are given are where they begin
    if (parameters.adaptivity.target_error)
      for (BodyParameters &body : parameters.bodies)
        raise_to_mixed_form(body);
    parameters.assignments = assignments;
    return parameters;
  }

  Parameters
  parse_parameters(const std::string &text,
                   const std::string &file,
                   const Settings    &settings)
  {
    return parse_parameters(collect(text, file, settings), file);
  }

  Parameters
  read_parameters(const std::string &file,
                  const Settings    &settings,
                  const MPI_Comm     comm)
  {
    // Rank 0 reads the files; all parse the same lines, so that all see the
    // same error.
    std::string             message;
    std::vector<Assignment> assignments;
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      try
        {
          assignments = collect(read_text_file(file), file, settings);
        }
      catch (const InputError &e)
        {
          message = e.what();
        }
    throw_if_any(message, comm);
    assignments = dealii::Utilities::MPI::broadcast(comm, assignments);
    return parse_parameters(assignments, file);
  }
} // namespace mortise
