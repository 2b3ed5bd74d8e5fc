#include <mortise/base/error.h>
#include <mortise/base/quotes.h>
#include <mortise/problem/input/command_line.h>
#include <mortise/problem/report_program.h>
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

    /// Directories that may have the package: beside an installed program, and
    /// where it was compiled.
    std::vector<fs::path>
    python_directories()
    {
      std::error_code ignored;
      const fs::path  program = fs::read_symlink("/proc/self/exe", ignored);
      std::vector<fs::path> directories;
      if (!program.empty())
        directories.push_back(program.parent_path().parent_path() /
                              "share/mortise/python");
      directories.push_back(MORTISE_PYTHON_DIRECTORY);
      return directories;
    }

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
    std::string sought;
    for (const fs::path &directory : python_directories())
      {
        if (std::error_code ignored;
            fs::exists(directory / "mortise/report.py", ignored))
          return run_python(directory, line.results);
        sought +=
          (sought.empty() ? "" : " and ") + file_in_quotes(directory.string());
      }
    return fail("the Python package that makes the page is neither in " +
                sought);
  }
} // namespace mortise
