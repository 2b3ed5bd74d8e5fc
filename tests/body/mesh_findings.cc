// All that is wrong with the mesh of a file is told at once, each kind with its
// number and places, the same on all ranks; what may be meant is a warning and
// no error.

#include <mortise/body/mesh/mesh_findings.h>
#include <mortise/body/mesh/mesh_source.h>
#include <verdict.h>

#include <algorithm>

#include "gmsh_meshes.h"

using namespace gmsh_test;

namespace
{
  void
  check_errors(const std::string              &what,
               const mortise::MeshParameters  &q,
               const std::vector<std::string> &fragments)
  {
    const std::string message = message_of(q);
    check_message(what, message, fragments);
    verdict(std::count(message.begin(), message.end(), '\n') ==
              static_cast<long>(fragments.size()),
            what + ": no other kind of fault",
            message);
  }

  /// The mesh is taken, with these warnings and no others.
  void
  check_warnings(const std::string              &what,
                 const mortise::MeshParameters  &q,
                 const std::vector<std::string> &fragments)
  {
    std::vector<std::string> warnings;
    std::string              text;
    text = ::message_of([&] {
      warnings = mortise::create_mesh(q, MPI_COMM_WORLD, "Mesh", {}).warnings;
    });
    for (const std::string &warning : warnings)
      text += "\n" + warning;
    auto all = fragments;
    all.emplace_back("(no error)");
    check_message(what, text, all);
    verdict(warnings.size() == fragments.size(),
            what + ": no other warning",
            text);
  }

  const std::vector<std::string> corners = {"0 0 0",
                                            "1 0 0",
                                            "0 1 0",
                                            "0 0 1",
                                            "1 1 1"};
  const std::string face = "2 2 7 1 1 2 3", cell = "4 2 1 1 1 2 3 4";

  void
  check_msh()
  {
    std::vector<std::string> nodes = corners;
    for (const char *more : {"1 0 0",
                             "5 5 5",
                             "3 0 0",
                             "4 0 0",
                             "3 1 0",
                             "3 0 1",
                             "0.5 0.5 -1",
                             "-1 -1 -1"})
      nodes.emplace_back(more);
    mortise::MeshParameters q =
      file_parameters(write_file("faults.msh",
                                 mesh_text(nodes,
                                           {face,
                                            "2 2 8 1 1 2 5",
                                            cell,
                                            "4 2 1 1 2 4 3 5",
                                            cell,
                                            "4 2 1 1 8 9 10 11",
                                            "4 2 1 1 1 2 3 12",
                                            "4 2 1 1 1 2 3 13",
                                            "4 2 1 1 1 3 4 6"})));
    q.boundaries = "hole: cylinder radius 5; top: plane z = 9";
    check_errors(
      "nine faults in a file of gmsh",
      q,
      {"error: surface elements that are a face of no cell: 1, element 2 of "
       "'8' between the nodes 1, 2, 5, the first at (0, 0, 0)",
       "error: faces of more than two cells: 1, cells 3, 7, 8 at (0.333333, "
       "0.333333, 0)",
       "error: cells that are turned inside out (negative volume): 3, cell 4 "
       "at (0.5, 0.5, 0.5), cell 7 at (0.375, 0.375, -0.25), cell 8 at",
       "error: Boundaries, 'hole: cylinder radius 5', 'top: plane z = 9' "
       "choose no face",
       "error: pairs of nodes at one place, which leave the cells apart there: "
       "1, nodes 2 and 6 at (1, 0, 0)",
       "warning: cells with the same nodes as another one: 1, cells 3 and 5 at "
       "(0.25, 0.25, 0.25)",
       "warning: parts that are not connected with the rest of the body: 1, "
       "cell 6 and 0 more at (3.25, 0.25, 0.25)",
       "warning: nodes that no cell and no face has: 1, node 7 at (5, 5, 5)"});
    check_warnings(
      "two parts, each with a cell for two physical volumes",
      file_parameters(write_file(
        "parts.msh",
        mesh_text({nodes.begin(), nodes.begin() + 11},
                  {face, cell, "4 2 2 1 1 2 3 4", "4 2 1 1 8 9 10 11"}))),
      {"parts that are not connected with the rest of the body: 1",
       "nodes that no cell and no face has: 3, node 5 at (1, 1, 1)"});
    check_warnings("nothing to tell",
                   file_parameters(write_file("sound.msh",
                                              mesh_text({corners.begin(),
                                                         corners.begin() + 4},
                                                        {face, cell}))),
                   {});
    check_warnings(
      "a tiny edge",
      file_parameters(write_file(
        "tiny.msh",
        mesh_text({"0 0 0", "1e-6 0 0", "0 1 0", "0 0 1"}, {face, cell}))),
      {"edges shorter than 1e-5 of the body: 1, cell 2 between the nodes 1 "
       "and 2 at (0, 0, 0)"});
    check_warnings("nodes that nearly are one",
                   file_parameters(
                     write_file("near.msh",
                                mesh_text({"0 0 0",
                                           "1 0 0",
                                           "0 1 0",
                                           "0 0 1",
                                           "1.0000001 0 0",
                                           "2 0 0",
                                           "2 1 0",
                                           "2 0 1"},
                                          {face, cell, "4 2 1 1 5 6 7 8"}))),
                   {"pairs of nodes less than 1e-6 of the body apart that no "
                    "cell joins: 1, nodes 2 and 5 at (1, 0, 0)",
                    "parts that are not connected"});
  }

  /// Two cubes side by side, from @p nodes_of_second, with @p more lines.
  std::string
  two_cubes(const std::string &nodes_of_second, const std::string &more)
  {
    return "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n"
           "8,0,1,1\n9,2,0,0\n10,2,1,0\n11,2,0,1\n12,2,1,1\n21,1,0,0\n22,1,1,0\n"
           "23,1,0,1\n24,1,1,1\n*ELEMENT, TYPE=C3D8, ELSET=all\n"
           "10, 1,2,3,4,5,6,7,8\n20, " +
           nodes_of_second + "\n" + more;
  }

  void
  check_inp()
  {
    const std::string left = "*SURFACE, NAME=left\n10, S6\n";
    const auto        deck = [&](const std::string &second,
                          const std::string &more = "") {
      return file_parameters(
        write_file("faults.inp", two_cubes(second, more + left)));
    };
    check_errors("a crack and a repeated cell in a file of Abaqus",
                 deck("21,9,10,22,23,11,12,24", "30, 2,3,4,1,6,7,8,5\n"),
                 {"error: pairs of nodes at one place, which leave the cells "
                  "apart there: 4, nodes 2 and 21 at (1, 0, 0), ",
                  "warning: cells with the same nodes as another one: 1, cells "
                  "10 and 30 at (0.5, 0.5, 0.5)",
                  "warning: parts that are not connected with the rest of the "
                  "body: 1, cell 20 and 0 more at (1.5, 0.5, 0.5)"});
    check_errors("a cell without volume, one that is turned, orphan nodes",
                 deck("2,3,10,9,6,7,12,11", "30, 9,10,10,9,11,12,12,11\n"),
                 {"error: faces of more than two cells: 1, cells 20, 30 at (2, "
                  "0.5, 0.5)",
                  "error: cells without volume: 1, cell 30 at (2, 0.5, 0.5)",
                  "error: cells that are turned inside out (negative volume): "
                  "1, cell 20 at (1.5, 0.5, 0.5); allowed: convex hexahedra",
                  "warning: nodes that no cell and no face has: 4, node 21 at "
                  "(1, 0, 0)"});
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_msh();
  check_inp();
}
