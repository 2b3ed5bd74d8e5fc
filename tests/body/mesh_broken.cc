// Every kind of broken mesh file is refused with a message that says what is
// wrong and where, the same on all ranks, and nothing hangs or crashes.

#include <verdict.h>

#include <cmath>
#include <limits>
#include <random>

#include "gmsh_meshes.h"

using namespace dealii;
using namespace gmsh_test;

namespace
{
  const std::string cube = R"(
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
MeshSize{:} = 0.5;
Physical Volume("cube") = {1};
Physical Surface("low") = {5};
)";

  mortise::MeshParameters
  broken(const std::string &content)
  {
    return file_parameters(write_file("broken.msh", content));
  }

  /// A file cut anywhere is refused, or still has all that counts.
  void
  check_cut_files(const Format &format)
  {
    const std::string whole = read_file(write_mesh("broken_cut", cube, format));
    unsigned int      bad   = 0;
    std::string       message;
    for (unsigned int i = 0; i < 20; ++i)
      {
        message = message_of(broken(whole.substr(0, whole.size() * i / 20)));
        bad += message.find("Mesh: the mesh file '") != 0;
      }
    verdict(bad == 0,
            "refused: a file that ends early, version " +
              std::to_string(format.version).substr(0, 3) +
              (format.binary ? ", binary" : ", ASCII"),
            std::to_string(bad) + " accepted; " + message);
  }

  /// Bytes overwritten at random are an error or a mesh, never a crash.
  void
  check_garbage(const Format &format)
  {
    const std::string whole = read_file(write_mesh("broken_cut", cube, format));
    std::mt19937      random(7);
    for (unsigned int i = 0; i < 60; ++i)
      {
        std::string damaged = whole;
        for (unsigned int k = 0; k < 5; ++k)
          damaged[60 + random() % (whole.size() - 60)] =
            static_cast<char>(random() % 256);
        message_of(broken(damaged));
      }
    std::string noise = "$MeshFormat\n4.1 1 8\n";
    while (noise.size() < 5000)
      noise += static_cast<char>(random() % 256);
    refused("binary garbage", broken(noise), "byte order");
    const int one = 1;
    noise         = "$MeshFormat\n4.1 1 8\n" +
            std::string(reinterpret_cast<const char *>(&one), sizeof(int)) +
            "\n$EndMeshFormat\n$Nodes\n" + noise + "$EndNodes\n$Elements\n" +
            noise + "$EndElements\n";
    refused("garbage with the right words", broken(noise), "mesh file");
  }

  /// @p text with a number, a line or the end changed.
  std::string
  with_lies(const std::string &text, std::mt19937 &random)
  {
    std::vector<std::string> lines;
    std::vector<std::size_t> heads; // the two lines after a section's name
    std::istringstream       in(text);
    for (std::string line; std::getline(in, line);)
      {
        if (line[0] == '$')
          heads.insert(heads.end(), {lines.size() + 1, lines.size() + 2});
        lines.push_back(line);
      }
    heads.resize(heads.size() - 2);
    std::size_t  at   = random() % 2 == 0 ? heads[random() % heads.size()] :
                                            random() % lines.size();
    std::string &line = lines[at];
    switch (random() % 6)
      {
        case 0:
          lines.erase(lines.begin() + at);
          break;
        case 1:
          lines.insert(lines.begin() + at, std::string(line));
          break;
        case 2:
          lines.resize(at);
          break;
        default:
          {
            std::vector<std::string> words;
            std::istringstream       of_line(line);
            for (std::string word; of_line >> word;)
              words.push_back(word);
            static const std::vector<std::string> numbers = {
              "0",
              "1",
              "-1",
              "3",
              "7",
              "1000003",
              "2147483648",
              "4294967297",
              "18446744073709551615",
              "x",
              "",
              "1e999"};
            if (!words.empty())
              words[random() % words.size()] =
                numbers[random() % numbers.size()];
            line.clear();
            for (const std::string &word : words)
              line += word + " ";
          }
      }
    std::string result;
    for (const std::string &one : lines)
      result += one + "\n";
    return result;
  }

  /// Counts that do not agree with what follows are an error: none is taken on
  /// trust.
  void
  check_lies()
  {
    const std::string whole =
      read_file(write_mesh("broken_lies", cube, {4.1, false, 1, false, false}));
    const std::string whole_2 = read_file(
      write_mesh("broken_lies_2", cube, {2.2, false, 1, false, false}));
    const auto changed = [](const std::string &text,
                            const std::string &section,
                            const unsigned int n,
                            const std::string &number) {
      std::size_t at = text.find("$" + section) + section.size() + 2;
      for (unsigned int i = 0; i < n; ++i)
        at = text.find_first_of(" \n", at) + 1;
      return broken(text.substr(0, at) + number +
                    text.substr(text.find_first_of(" \n", at)));
    };
    refused("fewer nodes in all than in the blocks",
            changed(whole, "Nodes", 1, "1"),
            "nodes, the header of the section says 1");
    refused("fewer elements in all than in the blocks",
            changed(whole, "Elements", 1, "1"),
            "elements, the header of the section says 1");
    refused("a largest tag that is none",
            changed(whole, "Nodes", 3, "2"),
            "the tag 3 is none of those that the header of the section tells; "
            "allowed: 1 to 2");
    refused("a negative number of blocks",
            changed(whole, "Elements", 0, "-1"),
            "there is the number -1 where things are counted");
    refused("nodes beyond the end",
            changed(whole_2, "Nodes", 0, "100000"),
            "in $Nodes, line ");
    refused("an element more than there are",
            changed(whole_2, "Elements", 0, "1000"),
            "in $Elements, line ");
    std::string text = whole;
    text.replace(text.find("$EndNodes"), 0, "$EndNodes\n");
    refused("the end of a section twice", broken(text), "in $EndNodes, line ");
    text = whole;
    text += whole.substr(whole.find("$Nodes"));
    refused("nodes twice", broken(text), "comes a second time");
    text = whole;
    text.replace(text.find("\n2 5 ", text.find("$Elements")), 4, "\n2 9");
    refused("elements of an unknown surface",
            broken(text),
            "elements of the surface 9");

    std::mt19937 random(11);
    for (unsigned int i = 0; i < 150; ++i)
      for (const std::string &one : {whole, whole_2})
        {
          const std::string message =
            message_of(broken(with_lies(one, random)));
          if (message != "(no error)" &&
              message.find("Mesh: the mesh file '") != 0)
            verdict(false, "one message", message);
        }
    verdict(true, "300 files with one lie each");
  }

  void
  check_cells()
  {
    const std::vector<std::string> corners = {
      "0 0 0", "1 0 0", "0 1 0", "0 0 1", "1 1 1"};
    const std::string face = "2 2 7 1 1 2 3", first = "4 2 1 1 1 2 3 4",
                      second = "4 2 1 1 2 4 3 5"; // on the face 2 3 4
    verdict(message_of(
              broken(mesh_text(corners, {face, first, "4 2 1 1 2 3 4 5"}))) ==
              "(no error)",
            "two good tetrahedra");
    refused(
      "a tetrahedron of negative volume",
      broken(mesh_text(corners, {face, first, second})),
      "turned inside out (negative volume): 1, cell 3 at (0.5, 0.5, 0.5)");
    verdict(message_of(
              broken(mesh_text(corners, {face, "4 2 1 1 2 1 3 4", second}))) ==
              "(no error)",
            "a mesh that is numbered inside out as a whole");
    refused("a tetrahedron without volume",
            broken(
              mesh_text({"0 0 0", "1 0 0", "0 1 0", "1 1 0"}, {face, first})),
            "without volume");
    refused("cells that overlap",
            broken(
              mesh_text({"0 0 0", "1 0 0", "0 1 0", "0 0 1", "0 0 2", "0 0 3"},
                        {face, first, "4 2 1 1 1 2 3 5", "4 2 1 1 1 2 3 6"})),
            "faces of more than two cells: 1, cells 2, 3, 4 at (0.333333, "
            "0.333333, 0)");
    refused("a wedge of negative volume beside a tetrahedron",
            broken(mesh_text(
              {"0 0 0", "1 0 0", "0 1 0", "0 0 1", "1 0 1", "0 1 1", "0 0 -1"},
              {"2 2 7 1 4 5 6", "6 2 1 1 4 5 6 1 2 3", "4 2 1 1 1 3 2 7"})),
            "turned inside out (negative volume): 1, cell 2 at");
    refused("surfaces only",
            broken(mesh_text(corners, {face})),
            "no volume elements");
    refused("no physical surface",
            broken(mesh_text(corners, {first})),
            "names no boundary; allowed: a mesh with physical surfaces");
    refused("a physical surface elsewhere",
            broken(mesh_text(corners, {"2 2 7 1 2 3 5", first})),
            "names no boundary of this part");
    refused("a surface in two physical ones",
            broken(mesh_text(corners, {face, "2 2 8 1 1 2 3", first})),
            "faces in several physical surfaces: 1, cell 3 in 7, 8 at");
    refused("a face in two surfaces, each in a physical one",
            broken(mesh_text(corners, {face, "2 2 8 2 1 2 3", first})),
            "faces in several physical surfaces: 1, cell 3 in 7, 8 at");
    refused("a file of third order",
            file_parameters(
              write_mesh("broken_third", cube, {4.1, false, 3, false, false})),
            "cells of order 3");
  }

  /// Elements of physical surfaces that are no faces.
  void
  check_surface_elements()
  {
    const std::vector<std::string> corners = {
      "0 0 0", "1 0 0", "0 1 0", "0 0 1", "1 1 1", "1 1 0", "1 0 1", "0 1 1"};
    const std::string face = "2 2 7 1 1 2 3", one = "4 2 1 1 1 2 3 4",
                      other = "4 2 2 2 2 3 4 5";
    refused(
      "a surface element through the body",
      broken(mesh_text(corners, {face, "2 2 7 1 1 2 5", one, other})),
      "surface elements that are a face of no cell: 1, element 2 of '7' between "
      "the nodes 1, 2, 5, the first at (0, 0, 0)");
    refused("a quadrilateral on a face that is a triangle",
            broken(mesh_text(corners, {face, "3 2 7 1 1 2 3 4", one, other})),
            "between the nodes 1, 2, 3, 4");
    const std::string cube    = "5 2 1 1 1 2 6 3 4 7 5 8";
    const std::string quad    = "3 2 7 1 1 2 6 3";
    const std::string between = "2 2 8 2 2 3 4"; // of two volumes
    refused("a triangle on a face that is a quadrilateral",
            broken(mesh_text(corners, {quad, "2 2 7 1 1 2 6", cube})),
            "between the nodes 1, 2, 6");
    refused("a quadrilateral through a cell",
            broken(mesh_text(corners, {quad, "3 2 7 1 1 2 5 8", cube})),
            "between the nodes 1, 2, 5, 8");
    verdict(message_of(broken(mesh_text(corners, {quad, cube}))) ==
              "(no error)",
            "a quadrilateral that is a face");
    verdict(message_of(broken(
              mesh_text(corners, {face, between, one, other}))) == "(no error)",
            "a named surface within the body");
    // volume 2 bridges the dent between the two cells of volume 1
    mortise::MeshParameters q = broken(mesh_text(
      {"0 0 0", "1 0 0", "0 1 0", "0 0 1", "1 1 1"},
      {face, "2 2 8 2 1 2 5", one, "4 2 1 1 2 3 4 5", "4 2 2 2 1 3 2 5"}));
    q.part                    = "1";
    verdict(message_of(q) == "(no error)",
            "a surface of another part between vertices of this one",
            message_of(q));
  }

  /// Coordinates that are no numbers, or too large or too small.
  void
  check_coordinates()
  {
    const std::vector<std::string> cells = {"2 2 7 1 1 2 3", "4 2 1 1 1 2 3 4"};
    for (const std::string x : {"inf", "-inf", "nan", "1e999"})
      refused("the coordinate " + x,
              broken(
                mesh_text({"0 0 0", "1 0 0", "0 1 0", "0 " + x + " 1"}, cells)),
              "of node 4, which is not finite");
    refused("the coordinate 1e200",
            broken(mesh_text({"0 0 0", "1 0 0", "0 1 1e200", "0 0 1"}, cells)),
            "has the coordinate z = 1e+200 of node 3; allowed: finite numbers "
            "of at most 1e+15");
    refused("a body of size 1e-50",
            broken(mesh_text({"0 0 0", "1e-50 0 0", "0 1e-50 0", "0 0 1e-50"},
                             cells)),
            "has a body of size 1.73205e-50, from (0, 0, 0) to");
    for (const bool binary : {false, true})
      {
        // the last of the coordinates 1 in the file becomes an infinite one
        std::string whole = read_file(
          write_mesh("broken_infinite", cube, {4.1, binary, 1, false, false}));
        const double one = 1., no = std::numeric_limits<double>::infinity();
        const std::string from =
          binary ? std::string(reinterpret_cast<const char *>(&one), 8) :
                   "\n1 1 1\n";
        const std::string to =
          binary ? std::string(reinterpret_cast<const char *>(&no), 8) :
                   "\n1 1 inf\n";
        const std::size_t nodes = whole.find("$Nodes"),
                          end   = whole.find("$EndNodes");
        const std::size_t at    = whole.rfind(from, end);
        verdict(at != std::string::npos && at > nodes, "a node at (1, 1, 1)");
        whole.replace(at, from.size(), to);
        refused(std::string("an infinite coordinate in version 4.1, ") +
                  (binary ? "binary" : "ASCII"),
                broken(whole),
                "= inf of node ");
      }
  }

  void
  check_folded_cell()
  {
    std::vector<std::string>       nodes    = {"0 0 0",
                                               "1 0 0",
                                               "0 1 0",
                                               "0 0 1",
                                               ".5 0 0",
                                               ".5 .5 0",
                                               "0 .5 0",
                                               "0 0 .5",
                                               "0 .5 .5",
                                               ".5 0 .5"};
    const std::vector<std::string> elements = {"9 2 7 1 1 2 3 5 6 7",
                                               "11 2 1 1 1 2 3 4 5 6 7 8 9 10"};
    verdict(message_of(broken(mesh_text(nodes, elements))) == "(no error)",
            "a good cell of second order");
    nodes[4] = ".9 0 0"; // the map doubles back before vertex 2
    refused("a folded cell of second order",
            broken(mesh_text(nodes, elements)),
            "their curved sides fold: 1, cell ");
    refused(
      "what helps against it",
      broken(mesh_text(nodes, elements)),
      "(in gmsh: Mesh.HighOrderOptimize = 2 or a finer mesh; or first order, with Curved boundaries)");
  }

  /// Two cubes that share no nodes at x = 1, of volumes @p left and @p right,
  /// with the physical surfaces @p a and @p b there (0: none).
  std::string
  two_cubes(const int left, const int right, const int a, const int b)
  {
    std::vector<std::string> nodes;
    for (const char *const x : {"0 ", "1 ", "1 ", "2 "})
      for (const char *const yz : {"0 0", "1 0", "1 1", "0 1"})
        nodes.push_back(std::string(x) + yz);
    const auto tags = [](const int group, const int entity) {
      return " 2 " + std::to_string(group) + " " + std::to_string(entity) + " ";
    };
    std::vector<std::string> elements = {"3" + tags(9, 9) + "1 2 3 4"};
    if (a != 0)
      elements.push_back("3" + tags(a, a) + "5 6 7 8");
    if (b != 0)
      elements.push_back("3" + tags(b, b) + "9 10 11 12");
    elements.push_back("5" + tags(left, left) + "1 2 3 4 5 6 7 8");
    elements.push_back("5" + tags(right, right) + "9 10 11 12 13 14 15 16");
    return mesh_text(nodes, elements);
  }

  void
  check_coinciding_nodes()
  {
    const std::string two = "at one place, which leave the cells apart there: ";
    refused("a crack", broken(two_cubes(1, 1, 0, 0)), two);
    refused("a crack named on one side", broken(two_cubes(1, 1, 7, 0)), two);
    refused("a crack within one volume, with one name",
            broken(two_cubes(1, 1, 7, 7)),
            two);
    refused("volumes that are apart without a name",
            broken(two_cubes(1, 2, 0, 0)),
            two);
    verdict(message_of(broken(two_cubes(1, 1, 7, 8))) == "(no error)",
            "a crack with two names is one that was meant");
    verdict(message_of(broken(two_cubes(1, 2, 7, 7))) == "(no error)",
            "so is a named surface between two volumes");
    mortise::MeshParameters q = broken(two_cubes(1, 2, 0, 0));
    q.part                    = "1";
    verdict(message_of(q) == "(no error)", "each part alone has no crack");
  }

  void
  check_geometries()
  {
    refused("a geometry with an error",
            file_parameters(write_file("broken.geo", "Point(1) = {0, 0\n")),
            "cannot be meshed; gmsh says: ");
    refused("a geometry without a volume",
            file_parameters(write_file("broken.geo",
                                       "SetFactory(\"OpenCASCADE\");\n"
                                       "Rectangle(1) = {0, 0, 0, 1, 1};\n")),
            "no volume elements");
    refused("CAD garbage",
            file_parameters(write_file("broken.brep", "garbage\n")),
            "does not hold the words CASCADE Topology");
    mortise::MeshParameters q = file_parameters(write_file("broken.geo", cube));
    q.mesh_size               = -1.;
    refused("a negative Mesh size", q, "Mesh size = -1; allowed: a positive");
    q           = broken("");
    q.mesh_size = 1.;
    refused("Mesh size for a mesh",
            q,
            "allowed: nothing for a file that is a mesh");
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const double version : {2.2, 4.1})
    for (const bool binary : {false, true})
      {
        const Format format = {version, binary, 1, false, false};
        check_cut_files(format);
        check_garbage(format);
      }
  refused("a file whose name is too long",
          file_parameters(std::string(100000, 'q') + ".msh"),
          "qqq.msh' cannot be read");
  check_lies();
  check_cells();
  check_surface_elements();
  check_coordinates();
  check_folded_cell();
  check_coinciding_nodes();
  check_geometries();
}
