// --boundaries: the faces of a geometry with their numbers, shapes, areas and
// places, in a table, a picture and a VTU file; and requests that are refused.

#include <deal.II/base/mpi.h>

#include <mortise/problem/boundary_list.h>
#include <verdict.h>

#include "../body/gmsh_meshes.h"

using gmsh_test::read_file;
using gmsh_test::write_file;

namespace
{
  const std::string plate = R"(
SetFactory("OpenCASCADE");
Box(1) = {-20, -20, 0, 40, 40, 10};
Cylinder(2) = {0, 0, -1, 0, 0, 12, 5};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
)";

  unsigned int
  count(const std::string &text, const std::string &part)
  {
    unsigned int n = 0;
    for (std::size_t at = text.find(part); at != std::string::npos;
         at             = text.find(part, at + 1))
      ++n;
    return n;
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const MPI_Comm                           comm = MPI_COMM_WORLD;
  const std::string geometry  = write_file("listed.geo", plate);
  const std::string directory = temporary_file("faces");
  const std::string text =
    mortise::list_boundaries(geometry,
                             {"Mesh size=4", "Output/Directory=" + directory},
                             comm);
  verdict(count(text, "  plane ") == 6 &&
            count(text, "  cylinder of radius 5 ") == 1,
          "six planes and a hole",
          text);
  verdict(count(text, "  400 ") == 4 && count(text, "  0, 20, 5 ") == 1,
          "areas and centres of the sides");
  const std::string picture = read_file(directory + "/listed-faces.svg");
  verdict(count(picture, "<text ") == 8 && count(picture, "</svg>") == 1,
          "each view shows three planes and the hole",
          picture.substr(0, 200));
  const std::string vtu = read_file(directory + "/listed-faces.vtu");
  verdict(count(vtu, "Name=\"face\"") == 1 && count(vtu, "</VTKFile>") == 1,
          "the numbers are in a file for ParaView");
  const auto refused = [&](const std::string &setting,
                           const std::string &fragment) {
    const std::string message =
      message_of([&] { mortise::list_boundaries(geometry, {setting}, comm); });
    verdict(message.find(fragment) != std::string::npos,
            "refused: " + setting,
            message);
  };
  refused("Degree=2", "allowed: \"Mesh size=...\", \"Part=...\" and");
  refused("Mesh size=x", "allowed: a positive length");
  refused("Part=shaft", "has no physical volume 'shaft'");
}
