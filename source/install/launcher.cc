// What is called mortise where one program has to run on all processors: starts
// the program that was compiled for the best of them that this machine has.
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace
{
  constexpr int wrong_input = 2; // as mortise::ExitCode says

  /// Levels of the x86-64 psABI, the best first.
  constexpr const char *levels[] = {MORTISE_LEVELS};

  bool
  has(const char *level)
  {
    // the compiler wants names of its own
    if (std::strcmp(level, "x86-64-v4") == 0)
      return __builtin_cpu_supports("x86-64-v4") != 0;
    if (std::strcmp(level, "x86-64-v3") == 0)
      return __builtin_cpu_supports("x86-64-v3") != 0;
    return false;
  }

  std::string
  best_level()
  {
    __builtin_cpu_init();
    for (const char *level : levels)
      if (has(level))
        return level;
    return "baseline";
  }

  /// The directory of this file with a slash at its end.
  std::string
  own_directory()
  {
    std::string   path(4096, '\0');
    const ssize_t length = readlink("/proc/self/exe", &path[0], path.size());
    path.resize(length > 0 ? length : 0);
    return path.substr(0, path.rfind('/') + 1);
  }
} // namespace

int
main(int, char *arguments[])
{
  // Ranks on machines of different kinds have to do the same arithmetic: a
  // variable names what all of them have.
  const char       *asked = std::getenv("MORTISE_PROCESSOR");
  const std::string level = asked != nullptr ? asked : best_level();
  const std::string here  = own_directory();
  std::string       reason;
  // installed, and where it was built
  for (const std::string &directory :
       {here + "../libexec/mortise/", here + "libexec/mortise/"})
    {
      execv((directory + "mortise-" + level).c_str(), arguments);
      reason +=
        "\n  " + directory + "mortise-" + level + ": " + std::strerror(errno);
    }
  std::fprintf(
    stderr,
    "error: cannot start the program for the processor \"%s\"%s:%s\n",
    level.c_str(),
    asked != nullptr ? " (MORTISE_PROCESSOR; allowed are baseline, "
                       "x86-64-v3, x86-64-v4)" :
                       "",
    reason.c_str());
  return wrong_input;
}
