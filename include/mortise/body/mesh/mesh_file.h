// Meshes from gmsh files: .msh of versions 2.2 and 4.1, ASCII and binary, of
// first and second order, and geometries (.geo, .step, .brep) that are meshed
// on the fly.
#pragma once

#include <mortise/body/mesh/generators.h>
#include <mortise/body/mesh/surface_patches.h>
#include <mpi.h>

#include <string>
#include <vector>

namespace mortise
{
  /// Name of the file that File means: itself, or within the directory of the
  /// parameter file if it is relative and exists only there.
  std::string
  located_file(const std::string &file_name, const std::string &directory);

  /// Check Source = file without reading the file: its format by its name, and
  /// Mesh size. Throws InputError (starting with @p where). Not collective.
  void
  check_file_parameters(const MeshParameters &parameters,
                        const std::string    &where);

  /// The body that @p parameters choose from their file, vertices already
  /// moved. Cells are either hexahedra, numbered as in deal.II, or tetrahedra
  /// of positive volume. Boundary ids and material ids are the tags of physical
  /// surfaces and volumes; boundaries without a name have their tag as name,
  /// and faces in no physical surface the id 0. Faces between this part and
  /// another one of the file are boundary faces.
  ///
  /// Rank 0 reads or meshes, the others get the same data. Collective; throws
  /// the same InputError on all ranks: for a file that is missing, damaged, or
  /// without names for its boundaries; for cells of unsuitable shape, order or
  /// volume; for nodes that coincide but are not joined.
  CoarseMesh
  read_mesh_file(const MeshParameters &parameters,
                 const std::string    &where,
                 MPI_Comm              comm);

  /// The surface of a mesh as a file has it.
  struct MeshSurface
  {
    CoarseMesh                mesh;
    std::vector<SurfacePatch> patches;
    /// Vertices around each boundary face, to the left seen from outside.
    std::vector<std::vector<unsigned int>> outer;
  };

  /// The surface of what read_mesh_file() would read, also where that would
  /// refuse the cells or names of the file. On one rank; throws InputError.
  MeshSurface
  read_surface(const MeshParameters &parameters, const std::string &where);

  /// A mesh as a file has it, and all that is wrong with it.
  struct MeshContents
  {
    CoarseMesh  mesh;        ///< wedges and the like are cut into tetrahedra
    std::string cells;       ///< before that: "8 pyramids, 30 wedges"
    std::size_t n_nodes = 0; ///< of the file
  };

  /// What read_mesh_file() would read, with the findings for which it would
  /// refuse it. On one rank; throws InputError where there is no mesh at all.
  MeshContents
  read_contents(const MeshParameters &parameters, const std::string &where);

  /// read_surface() of each part of the file, in the order of their numbers.
  std::vector<MeshSurface>
  read_parts(const MeshParameters &parameters, const std::string &where);
} // namespace mortise
