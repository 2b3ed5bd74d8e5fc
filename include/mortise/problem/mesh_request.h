// What --boundaries and --pairs are asked for, and how they print.
#pragma once

#include <mortise/body/mesh/mesh_source.h>
#include <mortise/problem/input/parameters.h>

#include <string>
#include <vector>

namespace mortise
{
  struct MeshRequest
  {
    MeshParameters mesh;
    std::string    directory       = ".";
    double         search_distance = 0.; ///< 0: not given
  };

  /// @p settings: "Mesh size=...", "Part=...", "Search distance=..." of --set, and
  /// --output. Throws InputError, starting with @p option, for others.
  MeshRequest
  read_mesh_request(const std::string &option,
                    const std::string &file,
                    const Settings    &settings);

  /// Rows of as many words, in columns with blanks between them.
  std::string
  text_table(const std::vector<std::vector<std::string>> &rows);
} // namespace mortise
