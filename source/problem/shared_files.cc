#include <mortise/base/error.h>
#include <mortise/base/quotes.h>
#include <mortise/problem/shared_files.h>

namespace mortise
{
  namespace fs = std::filesystem;

  fs::path
  shared_directory(const std::string &name)
  {
    std::error_code error;
    const fs::path  program = fs::read_symlink("/proc/self/exe", error);
    for (fs::path above = program; above.has_relative_path();)
      {
        above                    = above.parent_path();
        const fs::path directory = above / "share/mortise" / name;
        if (fs::is_directory(directory, error))
          return directory;
      }
    throw InputError("files that come with the program are missing: no "
                     "directory share/mortise/" +
                     name + " above " + file_in_quotes(program.string()));
  }
} // namespace mortise
