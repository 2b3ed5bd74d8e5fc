// The command line as data.
#pragma once

#include <mortise/problem/input/parameters.h>

#include <string>
#include <vector>

namespace mortise
{
  struct CommandLine
  {
    enum class Action
    {
      run,
      validate,         ///< parse, check combinations, open the meshes, stop
      print_parameters, ///< every parameter with default, unit and meaning
      print_parameters_as_json, ///< the same for programs
      report,                   ///< a page of the results in a directory
      info,                     ///< what is in a mesh or CAD file
      boundaries,               ///< list the faces of a mesh or CAD file
      pairs,   ///< list faces of its bodies that lie opposite each other
      import,  ///< make a scene of an input deck
      example, ///< list the scenes that come with the program, or write one
      print_help,
      print_version
    };

    Action      action = Action::run;
    std::string file; ///< the parameter file, a mesh, or the name of an example
    std::string restart; ///< directory of a checkpoint, instead of a file
    std::string results; ///< directory of the report
    Settings settings; ///< --set and --output, in the order of the command line
  };

  /// @p arguments without the name of the program. Throws InputError.
  CommandLine
  parse_command_line(const std::vector<std::string> &arguments);

  /// Text of --help.
  std::string
  help_text();

  /// Text of --version.
  std::string
  version_text();
} // namespace mortise
