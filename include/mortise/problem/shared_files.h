// Files that come with the program: scenes, meshes, the Python package.
#pragma once

#include <filesystem>
#include <string>

namespace mortise
{
  /// Directory @p name in share/mortise beside one of the directories above the
  /// program: where it is installed, or where it was built, a link to the
  /// sources. Throws InputError with where it was sought.
  std::filesystem::path
  shared_directory(const std::string &name);
} // namespace mortise
