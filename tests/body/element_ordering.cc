// Proves that is_consistently_ordered() sees meshes whose cells are not ordered
// consistently, that a Moebius strip cannot be ordered, and that after one
// uniform refinement, made into a coarse mesh of its own, it can.

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include <mortise/body/spaces/hp_constraints.h>
#include <verdict.h>

#include <iostream>

#include "element_meshes.h"

using namespace dealii;
using namespace element_test;

/// Whether the mesh is ordered consistently after an attempt to do so.
bool
can_be_ordered(const Triangulation<3> &triangulation)
{
  auto [vertices, cells, faces] =
    GridTools::get_coarse_mesh_description(triangulation);
  GridTools::consistently_order_cells(cells);
  Triangulation<3> ordered;
  ordered.create_triangulation(vertices, cells, SubCellData());
  return mortise::is_consistently_ordered(ordered);
}

int
main()
{
  for (const std::string &shape : shapes)
    {
      Triangulation<3> triangulation;
      create_shape(shape, 3, triangulation);
      verdict(mortise::is_consistently_ordered(triangulation),
              shape + ": ordered after turning its cells");
    }

  Triangulation<3> cube, turned;
  GridGenerator::subdivided_hyper_cube(cube, 2);
  verdict(mortise::is_consistently_ordered(cube), "a cube is ordered");
  auto [vertices, cells, faces] = GridTools::get_coarse_mesh_description(cube);
  std::mt19937 random(1);
  turn_cells(cells, random);
  turned.create_triangulation(vertices, cells, SubCellData());
  verdict(!mortise::is_consistently_ordered(turned),
          "a cube with turned cells is not");

  // A quarter turn of the cross section before the ends are joined.
  Triangulation<3> strip;
  GridGenerator::moebius(strip, 8, 1, 1., 0.2);
  verdict(!mortise::is_consistently_ordered(strip),
          "a Moebius strip is not ordered");
  verdict(!can_be_ordered(strip), "and cannot be");
  strip.refine_global(1);
  Triangulation<3> flat;
  GridGenerator::flatten_triangulation(strip, flat);
  verdict(can_be_ordered(flat), "after one refinement it can");
}
