// Meshes of Abaqus and CalculiX: all shapes of both orders in their own order
// of nodes, sets and surfaces as names of parts and boundaries, and what is
// told of files that are wrong.

#include <verdict.h>

#include <algorithm>
#include <cmath>

#include "gmsh_meshes.h"
#include "three_shapes.h"

using namespace dealii;
using namespace gmsh_test;
using namespace three_shapes;
using mortise::CoarseMesh;

namespace
{
  std::string
  deck_text(const bool quadratic)
  {
    const Deck            deck;
    std::vector<Point<3>> nodes = deck.vertices;
    std::map<std::pair<unsigned int, unsigned int>, unsigned> middles;
    std::ostringstream                                        elements;
    const char *const types[2][3] = {{"C3D8", "C3D6", "C3D4"},
                                     {"C3D20R", "C3D15", "C3D10M"}};
    for (unsigned int c = 0; c < 3; ++c)
      {
        elements << "*Element, type=" << types[quadratic][c]
                 << ", elset=" << (c == 0 ? "Brick" : "rest") << "\n"
                 << 10 * (c + 1);
        unsigned int n = 0;
        for (const unsigned int v : deck.cells[c])
          elements << (++n % 8 == 0 ? ",\n" : ", ") << v;
        for (const auto &edge : edges[c])
          if (quadratic)
            {
              const auto key =
                std::minmax(deck.cells[c][edge[0]], deck.cells[c][edge[1]]);
              const auto place = middles.emplace(key, nodes.size() + 1);
              if (place.second)
                nodes.push_back(nodes[key.first - 1] +
                                (nodes[key.second - 1] - nodes[key.first - 1]) /
                                  2.);
              elements << (++n % 8 == 0 ? ",\n" : ", ") << place.first->second;
            }
        elements << "\n";
      }
    std::ostringstream text;
    text.precision(17);
    text << "*Heading\n** a comment\n*NODE, NSET=Nall\n";
    for (unsigned int i = 0; i < nodes.size(); ++i)
      text << i + 1 << ", " << bent(nodes[i])[0] << ", " << bent(nodes[i])[1]
           << ",\t" << bent(nodes[i])[2] << "\n";
    return text.str() + elements.str() +
           "*NSET, NSET=Foot\n1, 2, 3,\n4\n"
           "*NSET, nset=Left\n1, 4, 5, 8\n*NSET, NSET=Under\nFoot, 9\n"
           "*ELSET, ELSET=lid, GENERATE\n30, 1000000000, 10\n"
           "*SURFACE, NAME=Load\nlid, S4\n"
           "*SURFACE, NAME=Front, TYPE=ELEMENT\n10, S3\nrest, S3\n"
           "*MATERIAL, NAME=steel\n*ELASTIC\n210000, 0.3\n*STEP\n*END STEP\n";
  }

  unsigned int
  n_faces(const CoarseMesh &mesh, const std::string &name)
  {
    unsigned int n = 0;
    for (const CellData<2> &face : mesh.faces.boundary_quads)
      n += mesh.names.boundaries.count(name) > 0 &&
           face.boundary_id == mesh.names.boundaries.at(name);
    return n;
  }

  std::string
  counts(const CoarseMesh &mesh)
  {
    std::string text;
    for (const auto &name : mesh.names.boundaries)
      text +=
        " " + name.first + " " + std::to_string(n_faces(mesh, name.first));
    return text;
  }

  void
  check_deck(const bool quadratic)
  {
    const std::string       what = quadratic ? "second order" : "first order";
    mortise::MeshParameters q =
      file_parameters(write_file("deck.inp", deck_text(quadratic)));
    q.boundaries          = "edge: named Under";
    const CoarseMesh mesh = mortise::read_mesh_file(q, "Mesh", MPI_COMM_WORLD);
    verdict(mesh.cells.size() == 6 + 3 + 1 &&
              (!quadratic ||
               std::fabs(volume_of(mesh) / exact_volume() - 1.) < 1e-13),
            what + ": all shapes" + (quadratic ? ", volume to 1e-13" : ""),
            std::to_string(volume_of(mesh)) + " " +
              std::to_string(exact_volume()));
    verdict(n_faces(mesh, "Load") == 1 && n_faces(mesh, "Front") == 5 &&
              n_faces(mesh, "edge") == 3 && n_faces(mesh, "Left") == 2,
            what + ": surfaces by sides of elements and by sets of nodes",
            counts(mesh));
    q.part       = "brick";
    q.boundaries = "";
    refused("names keep their case", q, "it has: Brick (hexahedra)");
    q.part                 = "Brick";
    const CoarseMesh brick = mortise::read_mesh_file(q, "Mesh", MPI_COMM_WORLD);
    verdict(brick.cells.size() == 1 && brick.cells[0].vertices.size() == 8 &&
              brick.remark.find("the sets Foot, Under of the file share") ==
                0 &&
              n_faces(brick, "Left") == 1 && n_faces(brick, "Load") == 0,
            what + ": a set of elements is a part; sets that overlap are told",
            brick.remark + counts(brick));
  }

  /// A part that is there twice, once moved by (0, 0, 1) and turned by 90
  /// degrees about an axis along z at (1, 0); nodes in a file of their own.
  void
  check_instances()
  {
    write_file("nodes.inc", "1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n");
    const std::string text =
      "*PART, NAME=p\n*NODE\n*INCLUDE, INPUT=" + temporary_file("nodes.inc") +
      "\n*ELEMENT, TYPE=C3D4, ELSET=e\n7, 1, 2, 3, 4\n*NSET, NSET=foot\n1, 2, 3\n"
      "*SURFACE, NAME=skin\ne\n*END PART\n*ASSEMBLY, NAME=a\n"
      "*INSTANCE, NAME=First, PART=P\n*END INSTANCE\n"
      "*INSTANCE, NAME=Second, PART=p\n0, 0, 1\n1, 0, 0, 1, 0, 1, 90\n*END INSTANCE\n"
      "*NSET, NSET=feet, INSTANCE=First\n1, 2, 3\n*NSET, NSET=feet\nSecond.foot\n"
      "*ELSET, ELSET=both, INSTANCE=Second\n7\n*ELSET, ELSET=both\nFirst.7\n"
      "*SURFACE, NAME=slant\nboth, S3\n*END ASSEMBLY\n";
    mortise::MeshParameters q =
      file_parameters(write_file("instances.inp", text));
    q.part                = "Second";
    q.boundaries          = "under: named feet; front: named slant";
    const CoarseMesh mesh = mortise::read_mesh_file(q, "Mesh", MPI_COMM_WORLD);
    // (x, y, z) goes to (1 - y, x - 1, z + 1)
    const std::vector<Point<3>> expected = {{1, -1, 1},
                                            {1, 0, 1},
                                            {0, -1, 1},
                                            {1, -1, 2}};
    bool                        moved    = mesh.vertices.size() == 4;
    for (const Point<3> &x : expected)
      moved = moved && std::any_of(mesh.vertices.begin(),
                                   mesh.vertices.end(),
                                   [&](const Point<3> &v) {
                                     return v.distance(x) < 1e-14;
                                   });
    verdict(moved, "an instance is moved, then turned");
    verdict(n_faces(mesh, "under") == 1 && n_faces(mesh, "front") == 1,
            "sets and surfaces of instances and of the assembly",
            counts(mesh));
    q.part               = "both";
    q.boundaries         = "all: named First.skin, Second.skin";
    const CoarseMesh all = mortise::read_mesh_file(q, "Mesh", MPI_COMM_WORLD);
    verdict(all.cells.size() == 2 && n_faces(all, "all") == 8,
            "a set of two instances, surfaces without sides",
            counts(all));
    refused("a number in an included file",
            file_parameters(write_file(
              "includes.inp",
              "*INCLUDE, INPUT=" +
                write_file("wrong.inc", "*NODE\n1, 0, 0, 0\n2, 0, y, 0\n") +
                "\n")),
            "has in line 3 of '" + temporary_file("wrong.inc") +
              "' 'y', which is no number");
    refused("a file that includes itself",
            file_parameters(write_file("itself.inp",
                                       "*INCLUDE, INPUT=" +
                                         temporary_file("itself.inp") + "\n")),
            "an *INCLUDE within 16 others");
    refused("an instance of no part",
            file_parameters(
              write_file("no_part.inp", "*INSTANCE, NAME=i, PART=q\n")),
            "an *INSTANCE of the part 'q'");
  }

  void
  check_refusals()
  {
    const std::string nodes  = "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n";
    const std::string cell   = "*ELEMENT, TYPE=C3D4, ELSET=e\n1, 1, 2, 3, 4\n";
    const auto        refuse = [](const std::string &what,
                           const std::string &text,
                           const std::string &fragment) {
      refused(what, file_parameters(write_file("wrong.inp", text)), fragment);
    };
    refuse("no element", nodes, "holds no *ELEMENT");
    refuse("a part without an instance",
           "*PART, NAME=p\n" + nodes + cell,
           "holds no *ELEMENT in an *INSTANCE");
    refuse("a coordinate", "*NODE\n1, 0, x, 0\n", "in line 2 'x', which is no");
    refuse("a node twice",
           nodes + "1,0,0,0\n",
           "in line 6 the node 1 a second time");
    refuse("a number of a node beyond all",
           "*NODE\n9300000000000000000, 0, 0, 0\n",
           "in line 2 '9300000000000000000', which is no integer");
    refuse("an unknown node",
           nodes + "*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 5\n",
           "in line 7 the node 5, which the file does not have before it");
    refuse("too few nodes",
           nodes + "*ELEMENT, TYPE=C3D4\n1, 1, 2\n*STEP\n",
           "an element with fewer than 4 nodes");
    refuse("another solid",
           nodes + "*ELEMENT, TYPE=C3D27\n",
           "in line 6 elements of type C3D27; allowed: C3D4");
    refuse("a side that is none",
           nodes + cell + "*SURFACE, NAME=s\n1, S5\n",
           "the side S5 of element 1, which has none such");
    refuse("a set that is none",
           nodes + cell + "*SURFACE, NAME=s\nx, S1\n",
           "in line 9 the set 'x', which the file does not have");
    refuse("nothing to refer to", nodes + cell, "names no boundary");
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_deck(false);
  check_deck(true);
  check_instances();
  check_refusals();
}
