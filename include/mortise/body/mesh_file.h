// Meshes from gmsh files (.msh 2.2 and 4.1, ASCII): hexahedra with flat or
// bilinear faces. It never moves, refines or curves the mesh.
#pragma once

#include <mortise/body/generators.h>

#include <string>

namespace mortise
{
  /// What a file says about itself, found without building a mesh.
  struct MeshFileSections
  {
    std::map<int, std::string>
      surface_names; ///< $PhysicalNames of dimension 2, by tag
    std::map<int, std::string> volume_names; ///< of dimension 3
    std::map<int, std::size_t>
      elements; ///< number of elements by gmsh's element type
  };

  /// Scan @p file_name. Throws InputError (starting with @p where) if it cannot be read, is not an
  /// ASCII .msh file of a known version, or holds other volume elements than
  /// 8-node hexahedra.
  MeshFileSections
  scan_mesh_file(const std::string &file_name, const std::string &where);

  /// Read the hexahedra, with boundary ids and material ids from the physical
  /// tags. Boundaries without a name get their tag as name. Throws InputError
  /// as scan_mesh_file() does, and for a mesh without hexahedra or with a
  /// boundary name that two surfaces share.
  CoarseMesh
  read_mesh_file(const std::string &file_name, const std::string &where);
} // namespace mortise
