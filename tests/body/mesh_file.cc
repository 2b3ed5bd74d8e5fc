// Meshes of hexahedra from gmsh files: both versions, names of boundaries,
// placement, cells that cannot be ordered consistently; damaged and unsuitable
// files are refused with a message.


#include <deal.II/grid/grid_tools.h>

#include <mortise/base/error.h>
#include <mortise/body/mesh/mesh_source.h>
#include <verdict.h>

#include <cmath>
#include <iostream>

#include "gmsh_meshes.h"

using namespace mortise;
using namespace dealii;

namespace
{
  using gmsh_test::refused;

  /// Two hexahedra, 2 x 1 x 1, in version 2.2. Surfaces: x = 0 "glued face"
  /// (1), z = 0 "bottom" (7), x = 2 without a name (12), the rest in no
  /// physical surface.
  const std::string version_2 = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
3
2 1 "glued face"
2 7 "bottom"
3 3 "steel"
$EndPhysicalNames
$Nodes
12
1 0 0 0
2 1 0 0
3 2 0 0
4 0 1 0
5 1 1 0
6 2 1 0
7 0 0 1
8 1 0 1
9 2 0 1
10 0 1 1
11 1 1 1
12 2 1 1
$EndNodes
$Elements
6
1 3 2 1 5 1 4 10 7
2 3 2 7 6 1 2 5 4
3 3 2 7 6 2 3 6 5
4 3 2 12 8 3 6 12 9
5 5 2 3 1 1 2 5 4 7 8 11 10
6 5 2 3 1 2 3 6 5 8 9 12 11
$EndElements
)";

  /// The same in version 4.1.
  const std::string version_4 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
3
2 1 "glued face"
2 7 "bottom"
3 3 "steel"
$EndPhysicalNames
$Entities
0 0 3 1
5 0 0 0 0 1 1 1 1 0
6 0 0 0 2 1 0 1 7 0
8 2 0 0 2 1 1 1 12 0
1 0 0 0 2 1 1 1 3 3 5 6 8
$EndEntities
$Nodes
1 12 1 12
3 1 0 12
1
2
3
4
5
6
7
8
9
10
11
12
0 0 0
1 0 0
2 0 0
0 1 0
1 1 0
2 1 0
0 0 1
1 0 1
2 0 1
0 1 1
1 1 1
2 1 1
$EndNodes
$Elements
4 6 1 6
2 5 3 1
1 1 4 10 7
2 6 3 2
2 1 2 5 4
3 2 3 6 5
2 8 3 1
4 3 6 12 9
3 1 5 2
5 1 2 5 4 7 8 11 10
6 2 3 6 5 8 9 12 11
$EndElements
)";

  /// A ring of 12 cells whose cross-section turns by 180 degrees: no order of
  /// its cells gives all edges one direction.
  std::string
  twisted_ring()
  {
    const unsigned int n = 12;
    std::ostringstream text;
    text.precision(16);
    text << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" << 4 * n << "\n";
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int v = 0; v < 4; ++v)
        {
          const double around = 2. * numbers::PI * k / n,
                       turn   = around / 2. + (v + 0.5) * numbers::PI / 2.;
          const double r      = 4. + std::cos(turn);
          text << 4 * k + v + 1 << " " << r * std::cos(around) << " "
               << r * std::sin(around) << " " << std::sin(turn) << "\n";
        }
    text << "$EndNodes\n$Elements\n"
         << n + 1 << "\n"
         << n + 1 << " 3 2 1 1 1 2 6 5\n"; // one face has a name
    for (unsigned int k = 0; k < n; ++k)
      {
        text << k + 1 << " 5 2 1 1";
        for (unsigned int side = 0; side < 2; ++side)
          for (unsigned int v = 0; v < 4; ++v)
            text << " "
                 << 4 * ((k + side) % n) + (v + (k + side == n ? 2 : 0)) % 4 +
                      1;
        text << "\n";
      }
    text << "$EndElements\n";
    return text.str();
  }

  MeshParameters
  file(const std::string &file_name, const std::string &content)
  {
    MeshParameters q =
      gmsh_test::file_parameters(gmsh_test::write_file(file_name, content));
    q.rotate    = {{0., 0., 90.}};
    q.translate = {{10., 0., 0.}};
    return q;
  }

  bool
  consistently_ordered(const Triangulation<3> &tria)
  {
    for (const auto &cell : tria.active_cell_iterators())
      for (const unsigned int l : cell->line_indices())
        if (!cell->line_orientation(l))
          return false;
    return true;
  }

  void
  check_version(const std::string &version, const std::string &content)
  {
    MeshParameters q = file("two_cells_" + version + ".msh", content);
    q.refinements    = 1;
    validate(q, "Mesh");
    const Mesh  mesh  = create_mesh(q, MPI_COMM_WORLD);
    const auto &tria  = *mesh.triangulation;
    const auto &names = mesh.names;
    verdict(names.boundaries ==
                std::map<std::string, types::boundary_id>(
                  {{"12", 12}, {"bottom", 7}, {"glued face", 1}}) &&
              names.materials ==
                std::map<types::material_id, std::string>({{3, "steel"}}) &&
              boundary_names(q) ==
                std::vector<std::string>({"12", "bottom", "glued face"}),
            "version " + version + ": names");
    // x -> y, y -> -x, then 10 along x: bottom is at z = 0, the glued face at y
    // = 0.
    double bottom = 0., glued = 0.;
    bool   placed = true;
    for (const auto &cell : tria.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary())
            {
              if (face->boundary_id() == 7)
                {
                  bottom += face->measure();
                  placed = placed && std::fabs(face->center()[2]) < 1e-14;
                }
              if (face->boundary_id() == 1)
                {
                  glued += face->measure();
                  placed = placed && std::fabs(face->center()[1]) < 1e-14 &&
                           face->center()[0] > 9. && face->center()[0] < 10.;
                }
            }
    bottom = Utilities::MPI::sum(bottom, MPI_COMM_WORLD);
    glued  = Utilities::MPI::sum(glued, MPI_COMM_WORLD);
    placed = Utilities::MPI::min(placed ? 1 : 0, MPI_COMM_WORLD) == 1;
    verdict(placed && std::fabs(bottom - 2.) < 1e-13 &&
              std::fabs(glued - 1.) < 1e-13,
            "version " + version + ": boundaries in their moved places");
    verdict(tria.n_global_active_cells() == 16,
            "version " + version + ": cells");
  }

  void
  check_ring()
  {
    const Mesh mesh =
      create_mesh(file("twisted_ring.msh", twisted_ring()), MPI_COMM_WORLD);
    const auto &tria = *mesh.triangulation;
    verdict(tria.n_global_active_cells() == 96 && consistently_ordered(tria),
            "a twisted ring is refined once and then consistently ordered");
  }

  std::string
  replaced(std::string text, const std::string &from, const std::string &to)
  {
    return text.replace(text.find(from), from.size(), to);
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_version("2.2", version_2);
  check_version("4.1", version_4);
  check_ring();

  MeshParameters missing = file("bad.msh", "");
  refused("an empty file", missing, "bad.msh' is empty");
  missing.file = "does_not_exist.msh";
  refused("a missing file", missing, "'does_not_exist.msh' cannot be read");
  missing.file = ".";
  refused("a folder", missing, "'.' has a name of no known format");
  missing.file = "mesh.stl";
  refused("another ending", missing, ".msh, .geo, .step, .stp, .brep");
  missing.file = "";
  refused("no file name", missing, "File =");
  refused("another format", file("bad.msh", "solid cube\n"), "$MeshFormat");
  refused("an old version",
          file("bad.msh", replaced(version_2, "2.2 0 8", "2.1 0 8")),
          "format version 2.1; allowed: 2.2 or 4.1");
  refused("a quadrilateral on one tetrahedron",
          file("bad.msh",
               replaced(version_2,
                        "6 5 2 3 1 2 3 6 5 8 9 12 11",
                        "6 4 2 3 1 2 3 6 9")),
          "surface elements that are a face of no cell: 1, element 3 of "
          "'bottom' between the nodes 2, 6, 5, the first at (1, 0, 0)");
  refused("no volume elements",
          file("bad.msh",
               replaced(replaced(replaced(version_2,
                                          "6 5 2 3 1 2 3 6 5 8 9 12 11\n",
                                          ""),
                                 "5 5 2 3 1 1 2 5 4 7 8 11 10\n",
                                 ""),
                        "$Elements\n6",
                        "$Elements\n4")),
          "no volume elements");
  refused("half a file",
          file("bad.msh", version_2.substr(0, version_2.size() / 2)),
          "is not a complete mesh: in $Nodes");

  const auto not_made = [](const std::string    &what,
                           const MeshParameters &q,
                           const std::string    &fragment) {
    check_message("refused: " + what,
                  [&] { create_mesh(q, MPI_COMM_WORLD, "Mesh"); },
                  {fragment});
  };
  not_made("an unknown node",
           file("bad.msh",
                replaced(version_2, "2 3 6 5 8 9 12 11", "2 3 6 5 8 9 12 99")),
           "not a complete mesh");
  not_made("a cell turned inside out",
           file("bad.msh", replaced(version_2, "12 2 1 1\n", "12 0.2 1 -3\n")),
           "inside out");
}
