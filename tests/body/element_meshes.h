// Meshes of the element tests: coarse shapes with cells turned at random and
// then ordered consistently, refined near a point, with degrees drawn at
// random.
#pragma once

#include <deal.II/distributed/tria.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include <random>
#include <string>
#include <vector>

namespace element_test
{
  using namespace dealii;

  const std::vector<std::string> shapes =
    {"cube", "ball", "cylinder", "quarter ball", "quarter shell", "shell"};

  /// Turn every cell by one of the 24 rotations of a cube, drawn at random.
  inline void
  turn_cells(std::vector<CellData<3>> &cells, std::mt19937 &random)
  {
    // Images of the vertices under a quarter turn about z and about x.
    const unsigned int about_z[8] = {1, 3, 0, 2, 5, 7, 4, 6};
    const unsigned int about_x[8] = {4, 5, 0, 1, 6, 7, 2, 3};
    for (CellData<3> &cell : cells)
      for (unsigned int turn = 0; turn < 6; ++turn)
        {
          const std::vector<unsigned int> before = cell.vertices;
          const auto &image = random() % 2 == 0 ? about_z : about_x;
          for (unsigned int v = 0; v < 8; ++v)
            cell.vertices[v] = before[image[v]];
        }
  }

  /// The same mesh with its cells turned at random, then ordered consistently.
  inline void
  create_shape(const std::string &shape,
               const unsigned int seed,
               Triangulation<3>  &triangulation)
  {
    Triangulation<3> coarse;
    if (shape == "cube")
      GridGenerator::subdivided_hyper_cube(coarse, 2);
    else if (shape == "ball")
      GridGenerator::hyper_ball(coarse);
    else if (shape == "cylinder")
      GridGenerator::cylinder(coarse);
    else if (shape == "quarter ball")
      GridGenerator::quarter_hyper_ball(coarse);
    else if (shape == "quarter shell")
      GridGenerator::quarter_hyper_shell(coarse, Point<3>(), 0.5, 1.);
    else
      GridGenerator::hyper_shell(coarse, Point<3>(), 0.5, 1., 6);

    auto [vertices, cells, faces] =
      GridTools::get_coarse_mesh_description(coarse);
    std::mt19937 random(seed);
    turn_cells(cells, random);
    for (auto &cell : cells)
      cell.manifold_id = numbers::flat_manifold_id;
    GridTools::consistently_order_cells(cells);
    triangulation.create_triangulation(vertices, cells, SubCellData());
  }

  /// A number that depends on the cell only, not on the rank or the order of
  /// the cells.
  template <typename CellIterator>
  unsigned int
  cell_number(const CellIterator &cell, const unsigned int seed)
  {
    std::mt19937 random(std::hash<std::string>()(cell->id().to_string()) +
                        7919 * seed);
    random.discard(3);
    return random();
  }

  /// Refine every fourth cell on average, drawn at random, and the first, @p times times.
  inline void
  refine_at_random(Triangulation<3>  &triangulation,
                   const unsigned int times,
                   unsigned int       seed)
  {
    for (unsigned int time = 0; time < times; ++time)
      {
        for (const auto &cell : triangulation.active_cell_iterators())
          if (cell->is_locally_owned() &&
              (cell_number(cell, seed + time) % 4 == 0 ||
               cell->id().to_string() == "0_0:"))
            cell->set_refine_flag();
        triangulation.execute_coarsening_and_refinement();
      }
  }

  /// Draw the element of each cell from @p first .. @p last (indices in the collection).
  inline void
  draw_degrees(DoFHandler<3> &dof_handler,
               unsigned int   first,
               unsigned int   last,
               unsigned int   seed)
  {
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        cell->set_active_fe_index(first +
                                  cell_number(cell, seed) % (last - first + 1));
  }
} // namespace element_test
