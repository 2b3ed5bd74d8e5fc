// A place for the files of a test program.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>

/// A new directory, which goes with the object and all that is in it.
class TemporaryDirectory
{
public:
  TemporaryDirectory()
    : path((std::filesystem::temp_directory_path() / "mortise_XXXXXX").string())
  {
    if (mkdtemp(path.data()) == nullptr)
      throw std::runtime_error("cannot make the directory " + path);
  }

  ~TemporaryDirectory()
  {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }

  TemporaryDirectory(const TemporaryDirectory &) = delete;
  TemporaryDirectory &
  operator=(const TemporaryDirectory &) = delete;

  std::string path;
};
