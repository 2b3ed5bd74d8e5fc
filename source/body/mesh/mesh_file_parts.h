// Conversion of a GmshModel to the coarse mesh of one body, in the coordinates
// of the file.
#pragma once

#include <mortise/body/mesh/generators.h>
#include <mortise/body/mesh/gmsh_model.h>
#include <mortise/body/mesh/inp_deck.h>
#include <mortise/body/mesh/mesh_file.h>
#include <mpi.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace mortise
{
  /// What @p file holds. @p fail is told if it cannot be read, or is empty.
  std::string
  content_of(const std::string &file, const FileError &fail);

  /// The mesh in the @p content of a .msh file of version 2.2 or 4.1, as text or
  /// bytes: without gmsh's library, which takes counts on trust and crashes,
  /// hangs or takes all memory where they are wrong. Every count must agree
  /// with what there is, and elements have nodes and entities that are there;
  /// else
  /// @p fail is told the line.
  GmshModel
  read_msh(const std::string &content, const FileError &fail);

  /// The mesh of the input file @p file of Abaqus or CalculiX (.inp): nodes,
  /// solid elements, sets, surfaces. Sets of elements are groups of volumes,
  /// and so is each instance; surfaces, sets of shells and membranes, and sides
  /// of cells whose nodes are all in a set of nodes are groups of surfaces,
  /// which may overlap. Materials, steps and the like are passed over.
  GmshModel
  read_inp(const std::string &file, const FileError &fail);

  /// The mesh in the @p content of an XML file of VTK (.vtu): an
  /// UnstructuredGrid of any number of pieces, as text, in base 64 or raw,
  /// compressed by zlib or not. Groups of volumes and surfaces are the ids that
  /// an array of integers gives to cells of dimension 3 and 2. Cells and points
  /// have the numbers of ParaView, from 0 on.
  GmshModel
  read_vtu(const std::string &content, const FileError &fail);

  /// The cells of @p parameters.part (all, if that is empty) with their
  /// vertices, boundary faces, names and curved geometry. What is wrong with
  /// faces and repeated cells is among its findings; @p fail is told why there
  /// can be no mesh.
  CoarseMesh
  select_part(const GmshModel      &model,
              const MeshParameters &parameters,
              const FileError      &fail);

  /// The cells of @p parameters.part as the file has them: "8 pyramids, 30
  /// wedges".
  std::string
  count_cells(const GmshModel      &model,
              const MeshParameters &parameters,
              const FileError      &fail);

  /// Give @p mesh the faces of only one cell, with the id of the physical surface
  /// that they are in (0: none), and the names of these. Vertices of cells are
  /// still nodes of @p model.
  void
  name_faces(const GmshModel &model, CoarseMesh &mesh);

  /// Refuse a body that is smaller or larger than numbers can stand.
  void
  check_size(const CoarseMesh &mesh, const FileError &fail);

  /// Turn the cells of a mesh that is numbered inside out as a whole, and find
  /// cells of negative or no volume otherwise.
  void
  check_volumes(CoarseMesh &mesh);

  /// The @p mesh of rank 0, without numbers in the file. Collective.
  CoarseMesh
  broadcast(const CoarseMesh &mesh, MPI_Comm comm);

  /// Put the cells in the order of a curve that fills space: what is near in
  /// memory is then near in space. Files have them in the order in which they
  /// were meshed.
  void
  sort_cells(CoarseMesh &mesh);

  /// Find nodes at one place, unless named boundaries say that they are the
  /// two sides of a surface: of two volumes, or of two names; and, as a
  /// warning, those that nearly are.
  void
  check_coinciding_nodes(CoarseMesh &mesh);

  /// Find what may be meant as it is: edges that are tiny beside the body, and
  /// parts that are not connected with the rest.
  void
  check_edges_and_parts(CoarseMesh &mesh);

  /// Pairs of the @p vertices of a cell (8 of a hexahedron, 4 of a tetrahedron).
  std::vector<std::array<unsigned int, 2>>
  cell_edges(const std::vector<unsigned int> &vertices);

  /// Find nodes of @p model that none of its elements has.
  void
  check_orphan_nodes(const GmshModel &model, CoarseMesh &mesh);
} // namespace mortise
