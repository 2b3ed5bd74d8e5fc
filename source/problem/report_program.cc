#include <mortise/base/error.h>
#include <mortise/problem/input/command_line.h>
#include <mortise/problem/report_program.h>
#include <mortise/problem/shared_files.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>

namespace mortise
{
  namespace
  {
    namespace fs = std::filesystem;

    int
    fail(const std::string &message)
    {
      std::cerr << "error: --report: " << message << std::endl;
      return static_cast<int>(ExitCode::invalid_input);
    }

    /// Does not come back if it works.
    int
    run_python(const fs::path &package, const std::string &results)
    {
      std::string path = package.string();
      if (const char *others = std::getenv("PYTHONPATH"))
        path += std::string(":") + others;
      setenv("PYTHONPATH", path.c_str(), 1);
      // -B: the package may lie where this user cannot or must not write
      execlp("python3",
             "python3",
             "-B",
             "-m",
             "mortise.report",
             "--",
             results.c_str(),
             static_cast<char *>(nullptr));
      return fail(std::string("the page is made by python3, which cannot be "
                              "started: ") +
                  std::strerror(errno) +
                  ". Install Python 3.9 or newer, or put it on PATH");
    }
  } // namespace

  std::optional<int>
  make_report_if_asked(const std::vector<std::string> &arguments)
  {
    CommandLine line;
    try
      {
        line = parse_command_line(arguments);
      }
    catch (const InputError &)
      {
        return {}; // is said when all ranks are there
      }
    if (line.action != CommandLine::Action::report)
      return {};
    for (const char *name : {"OMPI_COMM_WORLD_RANK", "PMI_RANK", "PMIX_RANK"})
      if (const char *rank = std::getenv(name);
          rank != nullptr && std::strcmp(rank, "0") != 0)
        return 0;
    try
      {
        return run_python(shared_directory("python"), line.results);
      }
    catch (const InputError &error)
      {
        return fail(error.what());
      }
  }
} // namespace mortise
