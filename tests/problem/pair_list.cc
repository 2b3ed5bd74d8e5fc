// --pairs: of bodies in one file, the faces that lie opposite each other with
// their areas and distances, and a scene that is valid; and what is refused.

#include <deal.II/base/mpi.h>

#include <mortise/problem/pair_list.h>
#include <verdict.h>

#include <algorithm>
#include <sstream>

#include "../body/gmsh_meshes.h"

using gmsh_test::read_file;
using gmsh_test::write_file;

namespace
{
  /// A plate with a hole, a pin in it, a block on the plate, another one 0.1
  /// above.
  const std::string assembly = R"(
SetFactory("OpenCASCADE");
Box(1) = {-20, -20, 0, 60, 40, 10};
Cylinder(2) = {0, 0, -1, 0, 0, 12, 5};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Cylinder(4) = {0, 0, -5, 0, 0, 20, 5};
Box(5) = {15, -10, 10, 20, 20, 10};
Box(6) = {15, -10, 20.1, 20, 20, 10};
Physical Volume("plate") = {3};
Physical Volume("the pin") = {4};
Physical Volume("block") = {5};
Physical Volume("lid") = {6};
)";

  bool
  holds(const std::string &text, const std::string &part)
  {
    return text.find(part) != std::string::npos;
  }

  /// The line of @p table that has both words.
  std::string
  row(const std::string &table, const std::string &a, const std::string &b)
  {
    std::istringstream lines(table);
    for (std::string line; std::getline(lines, line);)
      if (holds(line, a) && holds(line, b))
        return line;
    return "";
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const MPI_Comm                           comm = MPI_COMM_WORLD;
  const std::string       geometry  = write_file("assembly.geo", assembly);
  const std::string       directory = temporary_file("pairs");
  const mortise::Settings settings  = {"Mesh size=4",
                                       "Output/Directory=" + directory};
  const std::string       table = mortise::list_pairs(geometry, settings, comm);
  verdict(holds(table, "4 bodies"), "four bodies", table);
  verdict(holds(row(table, "the pin", "plate"), "cylinder of radius 5") &&
            holds(row(table, "the pin", "plate"), " 0 "),
          "the pin and its hole touch on a cylinder",
          row(table, "the pin", "plate"));
  verdict(holds(row(table, "plate", "block"), " 400 ") &&
            holds(row(table, "lid", "block"), " 400 ") &&
            holds(row(table, "lid", "block"), "  0.1 "),
          "area and distance of planes",
          row(table, "lid", "block"));
  verdict(row(table, "lid", "plate").empty() &&
            row(table, "lid", "the pin").empty(),
          "no pair where another body is between, or far",
          table);
  const std::string scene = read_file(directory + "/assembly.prm");
  verdict(holds(scene, "set Bodies     = plate, the_pin, block, lid") &&
            holds(scene, "set Part       = the pin") &&
            holds(scene, ": cylinder\n") && holds(scene, "set Law    = tie") &&
            holds(scene, "set Law    = contact"),
          "the scene has bodies, ties and contact",
          scene);
  const mortise::Parameters parameters =
    mortise::read_parameters(directory + "/assembly.prm", {}, comm);
  mortise::validate(parameters);
  verdict(parameters.bodies.size() == 4 && parameters.interfaces.size() == 3,
          "the scene is valid",
          std::to_string(parameters.interfaces.size()));
  bool has_sides = true;
  for (const auto &interface : parameters.interfaces)
    for (const auto &side : {interface.slave, interface.master})
      {
        const auto names =
          mortise::boundary_names(parameters.bodies[side.body].mesh);
        for (const std::string &boundary : side.boundaries)
          has_sides =
            has_sides && std::count(names.begin(), names.end(), boundary) == 1;
      }
  verdict(has_sides, "the meshes have the boundaries of the interfaces");
  const std::string again =
    message_of([&] { mortise::list_pairs(geometry, settings, comm); });
  verdict(holds(again, "which is there already"),
          "refused: a scene that is there",
          again);
  const std::string single =
    write_file("single.geo",
               "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 1, 1, 1};\n");
  const std::string one =
    message_of([&] { mortise::list_pairs(single, settings, comm); });
  verdict(holds(one, "has 1 bodies"), "refused: one body", one);
}
