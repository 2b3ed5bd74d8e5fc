#include <mortise/base/error.h>
#include <mortise/base/quotes.h>
#include <mortise/output/summary.h>
#include <mortise/problem/input/command_line.h>
#include <mortise/problem/input/parameter_file.h>

namespace mortise
{
  namespace
  {
    using Action = CommandLine::Action;

    const std::vector<std::string> option_names = {"--set",
                                                   "--output",
                                                   "--restart",
                                                   "--report",
                                                   "--validate",
                                                   "--parameters",
                                                   "--info",
                                                   "--boundaries",
                                                   "--pairs",
                                                   "--import",
                                                   "--example",
                                                   "--help",
                                                   "--version"};

    [[noreturn]] void
    fail(const std::string &what)
    {
      throw InputError(
        "command line: " + what +
        "\nusage: mortise [OPTION]... FILE.prm (see mortise --help)");
    }

    /// The value of "--set VALUE" or "--set=VALUE"; advances @p i over it.
    std::string
    value_of(const std::vector<std::string> &arguments,
             std::size_t                    &i,
             const std::string              &example)
    {
      const std::string &argument = arguments[i];
      const std::size_t  equals   = argument.find('=');
      if (equals != std::string::npos)
        return argument.substr(equals + 1);
      if (i + 1 >= arguments.size())
        fail(argument + " needs a value, as in " + argument + " " + example);
      return arguments[++i];
    }

    void
    set_action(CommandLine       &line,
               const Action       action,
               const std::string &option)
    {
      if (line.action != Action::run && line.action != action)
        fail(
          "got " + option +
          " and another option that asks for something else; allowed is one of "
          "--validate, --parameters, --report, --info, --boundaries, --pairs, --import, --example, --help, --version");
      line.action = action;
    }

    /// The directory that @p option names.
    std::string
    directory_of(const std::vector<std::string> &arguments,
                 std::size_t                    &i,
                 const std::string              &option)
    {
      const std::string directory = value_of(arguments, i, "results/mine");
      if (normalised(directory).empty())
        fail(option + " needs the name of a directory; got \"\"");
      return directory;
    }

    /// "--parameters" or "--parameters=json".
    void
    read_parameters_option(CommandLine       &line,
                           const std::string &argument,
                           const std::string &option)
    {
      const bool as_json = argument == option + "=json";
      if (!as_json && argument != option)
        fail("got " + in_quotes(argument) + "; allowed: " + option + ", " +
             option + "=json");
      set_action(line,
                 as_json ? Action::print_parameters_as_json :
                           Action::print_parameters,
                 option);
    }

    /// The option at position @p i; advances over its value.
    void
    read_option(CommandLine                    &line,
                const std::vector<std::string> &arguments,
                std::size_t                    &i)
    {
      const std::string option = arguments[i].substr(0, arguments[i].find('='));
      const bool        value  = option.size() < arguments[i].size();
      if (option == "--set")
        {
          line.settings.push_back(
            value_of(arguments, i, "\"Body inner/Degree=3\""));
          scan_setting(
            line.settings.back()); // says now what cannot be understood
        }
      else if (option == "--output")
        line.settings.push_back("Output/Directory=" +
                                directory_of(arguments, i, option));
      else if (option == "--restart")
        line.restart = directory_of(arguments, i, option);
      else if (option == "--report")
        {
          set_action(line, Action::report, option);
          line.results = directory_of(arguments, i, option);
        }
      else if (option == "--parameters")
        read_parameters_option(line, arguments[i], option);
      else if (value)
        fail("unknown option " + in_quotes(arguments[i]) +
             did_you_mean(option, option_names) +
             "; allowed: " + join_names(option_names));
      else if (option == "--validate")
        set_action(line, Action::validate, option);
      else if (option == "--info")
        set_action(line, Action::info, option);
      else if (option == "--boundaries")
        set_action(line, Action::boundaries, option);
      else if (option == "--pairs")
        set_action(line, Action::pairs, option);
      else if (option == "--import")
        set_action(line, Action::import, option);
      else if (option == "--example")
        set_action(line, Action::example, option);
      else if (option == "--help" || option == "-h")
        set_action(line, Action::print_help, option);
      else if (option == "--version")
        set_action(line, Action::print_version, option);
      else
        fail("unknown option " + in_quotes(option) +
             did_you_mean(option, option_names) +
             "; allowed: " + join_names(option_names));
    }
  } // namespace

  CommandLine
  parse_command_line(const std::vector<std::string> &arguments)
  {
    CommandLine line;
    for (std::size_t i = 0; i < arguments.size(); ++i)
      if (arguments[i].size() > 1 && arguments[i][0] == '-')
        read_option(line, arguments, i);
      else if (!line.file.empty())
        fail("got two parameter files, " + in_quotes(line.file) + " and " +
             in_quotes(arguments[i]) +
             "; allowed is one (a value with blanks needs quotes)");
      else
        line.file = arguments[i];
    const bool needs_file =
      line.action == Action::run || line.action == Action::validate;
    if (!line.restart.empty() && !line.file.empty())
      fail("got --restart and the parameter file " + in_quotes(line.file) +
           "; allowed is one of them (a checkpoint knows its parameters; --set "
           "changes them)");
    if (line.action == Action::report && !line.file.empty())
      fail("got --report and the parameter file " + in_quotes(line.file) +
           "; allowed is one of them");
    if ((line.action == Action::info || line.action == Action::boundaries ||
         line.action == Action::pairs) &&
        line.file.empty())
      fail(
        "a mesh or CAD file is needed, as in: mortise --boundaries part.step");
    if (line.action == Action::import && line.file.empty())
      fail("an input deck is needed, as in: mortise --import deck.inp");
    if (needs_file && line.file.empty() && line.restart.empty())
      fail("a parameter file is needed, as in: mortise prm/thick_sphere.prm");
    return line;
  }

  std::string
  help_text()
  {
    return "mortise ties elastic bodies whose meshes do not match, in three dimensions.\n"
           "\n"
           "  mortise [OPTION]... FILE.prm               run the scene of a parameter file\n"
           "  mpirun -n 4 mortise [OPTION]... FILE.prm   the same on four ranks\n"
           "  mortise --validate [OPTION]... FILE.prm    check the file and its meshes, then stop\n"
           "  mortise --restart DIR [OPTION]...          go on from the last checkpoint in DIR\n"
           "  mortise --report DIR                       a page of the results: DIR/report.html\n"
           "  mortise --parameters[=json]                every parameter: default, unit, meaning\n"
           "  mortise --info FILE                        sizes, names, quality and faults "
           "of a mesh or CAD file\n"
           "  mortise --boundaries FILE                  list the faces of a mesh or "
           "CAD file, with a picture\n"
           "  mortise --pairs FILE                       list faces of its bodies that "
           "lie opposite each\n"
           "                                             other, and write a scene\n"
           "  mortise --import FILE.inp                  make a scene of an input deck of "
           "Abaqus or CalculiX\n"
           "  mortise --example [NAME]                   list the scenes that come with the "
           "program, or write\n"
           "                                             one and its meshes here\n"
           "  mortise --help | --version\n"
           "\n"
           "Options:\n"
           "  --set \"SECTION/NAME=VALUE\"   set a parameter after the file is read; repeatable, "
           "as in\n"
           "                               --set \"Body inner/Mesh/Subdivisions=8, 4\"\n"
           "  --output DIR                 write results there (the same as --set "
           "Output/Directory=DIR)\n"
           "\n"
           "DIR/summary.json holds sizes, solver, errors, requested quantities and times of the "
           "run.\n"
           "Exit codes: 0 done; 1 a defect of the program; 2 the input is wrong (the message says "
           "what,\n"
           "where, what was got, what is allowed) or results cannot be written; 3 not converged "
           "(what was\n"
           "reached is written); 4 the machine is too small (memory); 128 + signal when "
           "interrupted.\n";
  }

  std::string
  version_text()
  {
    const ProgramInfo info = program_info(1);
    return info.name + " " + info.version + " (deal.II " + info.dealii + ", " +
           info.build_type + ")\n";
  }
} // namespace mortise
