// Pyramids, wedges and hexahedra are cut into tetrahedra that fit together,
// whatever the numbers of their vertices, and keep volume and names.

#include <mortise/body/mesh/cell_cutting.h>
#include <verdict.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>

#include "gmsh_meshes.h"

using namespace dealii;
using namespace gmsh_test;
using mortise::MeshParameters;

namespace
{
  struct Cells
  {
    std::vector<Point<3>>                  vertices;
    std::vector<std::vector<unsigned int>> cells; ///< in gmsh's order
  };

  /// A cube with a pyramid above and a wedge on its right.
  Cells
  stack_of_shapes()
  {
    return {{Point<3>(0, 0, 0),
             Point<3>(1, 0, 0),
             Point<3>(1, 1, 0),
             Point<3>(0, 1, 0),
             Point<3>(0, 0, 1),
             Point<3>(1, 0, 1),
             Point<3>(1, 1, 1),
             Point<3>(0, 1, 1),
             Point<3>(.5, .5, 2), // above
             Point<3>(2, 0, 0),
             Point<3>(2, 1, 0)},
            {{0, 1, 2, 3, 4, 5, 6, 7}, {4, 5, 6, 7, 8}, {1, 5, 9, 2, 6, 10}}};
  }

  double
  volume(const std::vector<Point<3>> &x, const std::array<unsigned int, 4> &t)
  {
    return cross_product_3d(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]) *
           (x[t[3]] - x[t[0]]) / 6.;
  }

  /// Numbers of vertices are drawn; a face between two cells comes twice.
  void
  check_neighbours()
  {
    const Cells  stack = stack_of_shapes();
    std::mt19937 random(5);
    bool         fits = true, positive = true, whole = true;
    for (unsigned int draw = 0; draw < 500; ++draw)
      {
        std::vector<unsigned int> number(stack.vertices.size());
        std::iota(number.begin(), number.end(), 0);
        std::shuffle(number.begin(), number.end(), random);
        std::vector<Point<3>> x(number.size());
        for (unsigned int v = 0; v < number.size(); ++v)
          x[number[v]] = stack.vertices[v];

        std::map<std::array<unsigned int, 3>, unsigned int> faces;
        double                                              sum = 0.;
        unsigned int                                        n   = 0;
        for (const auto &cell : stack.cells)
          {
            std::vector<unsigned int> vertices;
            for (const unsigned int v : cell)
              vertices.push_back(number[v]);
            for (const auto &part : mortise::cut_cell(vertices))
              {
                std::array<unsigned int, 4> t;
                for (unsigned int v = 0; v < 4; ++v)
                  t[v] = vertices[part[v]];
                positive = positive && volume(x, t) > 1e-3;
                sum += volume(x, t);
                ++n;
                for (unsigned int v = 0; v < 4; ++v)
                  {
                    std::array<unsigned int, 3> face;
                    for (unsigned int w = 0; w < 3; ++w)
                      face[w] = t[(v + 1 + w) % 4];
                    std::sort(face.begin(), face.end());
                    ++faces[face];
                  }
              }
          }
        // 6 + 2 + 3 tetrahedra; outside are 4 squares of the cube, 4 sides of
        // the pyramid, 2 triangles and 2 squares of the wedge
        const auto outer =
          std::count_if(faces.begin(), faces.end(), [](const auto &face) {
            return face.second == 1;
          });
        fits  = fits && outer == 18 && n == 11;
        whole = whole && std::fabs(sum - (1. + 1. / 3. + 0.5)) < 1e-12;
      }
    verdict(fits, "faces of neighbours are cut alike");
    verdict(positive, "all volumes are positive");
    verdict(whole, "the volume is that of the cells");
  }

  /// What a body is made of is told, and what cannot be cut is refused.
  void
  check_messages()
  {
    const std::string wedges_and_cube =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n10\n1 0 0 0\n2 1 0 0\n"
      "3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n9 2 0 0\n"
      "10 2 1 0\n$EndNodes\n$Elements\n3\n1 3 2 7 1 1 2 3 4\n"
      "2 5 2 1 1 1 2 3 4 5 6 7 8\n3 6 2 1 2 2 6 9 3 7 10\n$EndElements\n";
    MeshParameters q =
      file_parameters(write_file("shapes.msh", wedges_and_cube));
    const mortise::CoarseMesh mesh =
      mortise::read_mesh_file(q, "Mesh", MPI_COMM_WORLD);
    verdict(mesh.remark == "1 hexahedra, 1 wedges are cut into 9 tetrahedra" &&
              mesh.cells.size() == 9,
            "the log tells what was cut",
            mesh.remark);
    unsigned int named = 0;
    for (const CellData<2> &face : mesh.faces.boundary_quads)
      named += face.boundary_id == mesh.names.boundaries.at("7");
    verdict(named == 2, "a named quadrilateral becomes two named triangles");
    q.cells = "hexahedra";
    refused("Cells = hexahedra for other cells",
            q,
            "holds hexahedra, wedges, but Cells = hexahedra; allowed: auto or "
            "tetrahedra");
  }
} // namespace

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_neighbours();
  check_messages();
}
