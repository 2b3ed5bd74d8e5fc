// What --boundaries and --pairs are asked for.
#pragma once

#include <mortise/body/mesh/mesh_source.h>
#include <mortise/problem/input/parameters.h>

#include <string>

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
} // namespace mortise
