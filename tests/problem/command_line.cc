// Proves that the command line is read as documented and that a wrong one says
// what is allowed.
#include <mortise/base/error.h>
#include <mortise/problem/input/command_line.h>
#include <verdict.h>

#include <iostream>
#include <string>
#include <vector>

using namespace mortise;

namespace
{
  using Action = CommandLine::Action;

  void
  check_line(const std::string              &what,
             const std::vector<std::string> &arguments,
             const Action                    action,
             const std::string              &file,
             const Settings                 &settings)
  {
    const CommandLine line = parse_command_line(arguments);
    verdict(line.action == action && line.file == file &&
              line.settings == settings,
            what,
            line.file);
  }

  void
  check_error(const std::string              &what,
              const std::vector<std::string> &arguments,
              const std::vector<std::string> &parts)
  {
    check_message(
      what, [&] { parse_command_line(arguments); }, parts);
  }
} // namespace

int
main()
{
  check_line("a file", {"a.prm"}, Action::run, "a.prm", {});
  check_line("settings before and after the file, in order",
             {"--set", "Title=a b", "a.prm", "--set=Solver/Method=direct"},
             Action::run,
             "a.prm",
             {"Title=a b", "Solver/Method=direct"});
  check_line("the directory is a setting",
             {"--output", "some/where", "a.prm"},
             Action::run,
             "a.prm",
             {"Output/Directory=some/where"});
  check_line(
    "validate", {"--validate", "a.prm"}, Action::validate, "a.prm", {});
  check_line("parameters", {"--parameters"}, Action::print_parameters, "", {});
  check_line("parameters for programs",
             {"--parameters=json"},
             Action::print_parameters_as_json,
             "",
             {});
  check_line("report", {"--report", "some/where"}, Action::report, "", {});
  check_line("boundaries",
             {"--boundaries", "part.step", "--set", "Mesh size=2"},
             Action::boundaries,
             "part.step",
             {"Mesh size=2"});
  check_error("no mesh", {"--boundaries"}, {"a mesh or CAD file is needed"});
  check_line("information on a mesh",
             {"--info", "part.msh"},
             Action::info,
             "part.msh",
             {});
  check_error("no mesh for info", {"--info"}, {"a mesh or CAD file is needed"});
  check_line("import",
             {"--import", "deck.inp", "--output", "there"},
             Action::import,
             "deck.inp",
             {"Output/Directory=there"});
  check_error("no deck", {"--import"}, {"an input deck is needed"});
  check_line("examples", {"--example"}, Action::example, "", {});
  check_line(
    "an example", {"--example", "patch"}, Action::example, "patch", {});
  check_line("help", {"--help"}, Action::print_help, "", {});
  check_line("version", {"--version"}, Action::print_version, "", {});
  check_error("nothing", {}, {"a parameter file is needed", "usage: mortise"});
  check_error("validate nothing",
              {"--validate"},
              {"a parameter file is needed"});
  check_error("two files",
              {"a.prm", "b.prm"},
              {"\"a.prm\"", "\"b.prm\"", "allowed is one"});
  check_error("an unknown option",
              {"--ouput", "x", "a.prm"},
              {"\"--ouput\"", "did you mean \"--output\"", "--set"});
  check_error("an unknown option with a value",
              {"--sett=x", "a.prm"},
              {"--sett", "did you mean \"--set\""});
  check_error("a set without value",
              {"a.prm", "--set"},
              {"--set needs a value"});
  check_error("a set without =",
              {"--set", "Title", "a.prm"},
              {"--set \"Title\"", "NAME=VALUE"});
  check_error("an empty directory",
              {"--output", "", "a.prm"},
              {"--output", "got \"\""});
  check_error("another form of the parameters",
              {"--parameters=xml"},
              {"\"--parameters=xml\"", "--parameters=json"});
  check_error("a report of a file",
              {"--report", "some/where", "a.prm"},
              {"--report", "\"a.prm\"", "allowed is one of them"});
  check_error("two actions",
              {"--help", "--version"},
              {"--version", "allowed is one of"});
  bool all = true;
  for (const std::string option : {"--set",
                                   "--output",
                                   "--validate",
                                   "--report",
                                   "--parameters[=json]",
                                   "--boundaries",
                                   "--pairs",
                                   "--import",
                                   "--example",
                                   "--help",
                                   "--version"})
    all = all && help_text().find(option) != std::string::npos;
  verdict(all, "the help names every option");
  verdict(version_text().find("deal.II") != std::string::npos,
          "the version names deal.II");
  return 0;
}
