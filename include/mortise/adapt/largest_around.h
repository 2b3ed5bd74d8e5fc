// The largest of the numbers that cells around a cell have.
#pragma once

#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <mortise/base/types.h>

#include <algorithm>
#include <vector>

namespace mortise
{
  /// By owned cell, the largest that @p number(cell) is on it and the cells around it. Collective.
  template <typename Number>
  std::vector<unsigned int>
  largest_around(const dealii::Triangulation<dim> &triangulation,
                 const Number                     &number)
  {
    std::vector<unsigned int> at_vertex(triangulation.n_vertices(), 0);
    const auto take = [&](const auto &cell, const unsigned int of_cell) {
      for (const unsigned int v : cell->vertex_indices())
        at_vertex[cell->vertex_index(v)] =
          std::max(at_vertex[cell->vertex_index(v)], of_cell);
    };
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        take(cell, number(cell));
    dealii::GridTools::exchange_cell_data_to_ghosts<unsigned int,
                                                    dealii::Triangulation<dim>>(
      triangulation, number, take);
    std::vector<unsigned int> result(triangulation.n_active_cells(), 0);
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const unsigned int v : cell->vertex_indices())
          result[cell->active_cell_index()] =
            std::max(result[cell->active_cell_index()],
                     at_vertex[cell->vertex_index(v)]);
    return result;
  }
} // namespace mortise
