// --info: what is in a mesh or CAD file, how good its cells are, and what is
// wrong with it.
#pragma once

#include <mortise/problem/input/parameters.h>
#include <mpi.h>

#include <string>

namespace mortise
{
  /// Numbers of cells and nodes, box, volume and area, parts and boundaries,
  /// sizes and quality of the cells, and all faults of the mesh in @p file, which
  /// are no error here. @p settings: "Mesh size=..." and "Part=..." with the
  /// meaning that they have for a body. Collective; the text is that of rank 0.
  /// Throws InputError for a file in which there is no mesh.
  std::string
  mesh_info(const std::string &file, const Settings &settings, MPI_Comm comm);
} // namespace mortise
