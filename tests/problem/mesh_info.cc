// --info: numbers, box, volume, area, names and quality of meshes for which all
// of these are known, in several formats, and faults beside them.

#include <deal.II/base/mpi.h>

#include <mortise/problem/mesh_info.h>
#include <verdict.h>

#include <sstream>

#include "../body/gmsh_meshes.h"

using gmsh_test::mesh_text;
using gmsh_test::write_file;

namespace
{
  /// @p text with one blank between words.
  std::string
  squeezed(const std::string &text)
  {
    std::istringstream in(text);
    std::string        result;
    for (std::string word; in >> word;)
      result += word + " ";
    return result;
  }

  void
  check(const std::string              &what,
        const std::string              &file,
        const std::vector<std::string> &fragments,
        const mortise::Settings        &settings = {})
  {
    std::string       text;
    const std::string error = message_of(
      [&] { text = mortise::mesh_info(file, settings, MPI_COMM_WORLD); });
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      for (const std::string &fragment : fragments)
        verdict(squeezed(text + error).find(fragment) != std::string::npos,
                what + ": " + fragment,
                text + error);
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check(
    "a box of Abaqus",
    write_file("box.inp",
               "*NODE\n1,0,0,0\n2,1,0,0\n3,1,2,0\n4,0,2,0\n5,0,0,4\n"
               "6,1,0,4\n7,1,2,4\n8,0,2,4\n9,7,7,7\n"
               "*ELEMENT, TYPE=C3D8, ELSET=brick\n1, 1,2,3,4,5,6,7,8\n"
               "*SURFACE, NAME=left\n1, S6\n*SURFACE, NAME=sides\n1, S6\n"
               "1, S4\n"),
    {"cells 1 hexahedra nodes 9, of them vertices of cells: 8",
     "geometry of degree 1 box from 0, 0, 0 to 1, 2, 4, size 1, 2, 4 volume "
     "8 area 28",
     "brick 1 1 8 ",
     "left set 1 8 sides set 2 16",
     "(no name) - 6 28 ",
     "length of edges 1 2.333 4 cell 1 at (0.5, 1, 2)",
     "longest / shortest edge 4 4 4 cell 1",
     "scaled Jacobian 1 1 1 cell 1",
     "faults: warning: nodes that no cell and no face has: 1, node 9 at (7, "
     "7, 7)"});
  check("a sheared cube",
        write_file("sheared.msh",
                   mesh_text({"0 0 0",
                              "1 0 0",
                              "2 1 0",
                              "1 1 0",
                              "0 0 1",
                              "1 0 1",
                              "2 1 1",
                              "1 1 1"},
                             {"3 2 7 1 1 2 3 4", "5 2 1 1 1 2 3 4 5 6 7 8"})),
        {"volume 1 area 6.828",
         "7 7 1 1 ",
         "scaled Jacobian 0.7071 0.7071 0.7071",
         "longest / shortest edge 1.414 1.414 1.414",
         "no faults were found"});
  check("a regular tetrahedron",
        write_file("regular.msh",
                   mesh_text({"1 1 1", "1 -1 -1", "-1 1 -1", "-1 -1 1"},
                             {"2 2 7 1 1 2 3", "4 2 1 1 1 3 2 4"})),
        {"volume 2.667 area 13.86",
         "scaled Jacobian 1 1 1 ",
         "longest / shortest edge 1 1 1"});
  // x + 0.2 x (1 - x): the integral of 1.2 - 0.4 x over tetrahedron and face
  check("a curved tetrahedron",
        write_file("curved.msh",
                   mesh_text({"0 0 0",
                              "1 0 0",
                              "0 1 0",
                              "0 0 1",
                              "0.55 0 0",
                              "0.55 0.5 0",
                              "0 0.5 0",
                              "0 0 0.5",
                              "0 0.5 0.5",
                              "0.55 0 0.5"},
                             {"9 2 7 1 1 2 3 5 6 7",
                              "11 2 1 1 1 2 3 4 5 6 7 8 9 10"})),
        {"geometry of degree 2", "volume 0.1833", "7 7 1 0.5333"});
  check("wedges and a part",
        write_file(
          "wedge.msh",
          mesh_text(
            {"0 0 0", "1 0 0", "0 1 0", "0 0 1", "1 0 1", "0 1 1", "0 0 -1"},
            {"2 2 7 1 4 5 6", "6 2 1 1 1 2 3 4 5 6", "4 2 2 2 1 3 2 7"})),
        {"cells 1 wedges", "volume 0.5", "1 1 3 0.5"},
        {"Part=1"});
  check(
    "a geometry",
    write_file("ball.geo",
               "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 1, 1, 1};\n"),
    {"tetrahedra", "volume 1 area 6", "no faults were found"},
    {"Mesh size=0.5"});
  check("no mesh", "missing.msh", {"--info: the mesh file 'missing.msh'"});
}
