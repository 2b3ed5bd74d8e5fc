#include <deal.II/base/utilities.h>

#include <algorithm>
#include <numeric>

#include "mesh_file_parts.h"

namespace mortise
{
  using namespace dealii;

  void
  sort_cells(CoarseMesh &mesh)
  {
    std::vector<Point<3>> centres;
    for (const CellData<3> &cell : mesh.cells)
      {
        Point<3> sum;
        for (const unsigned int v : cell.vertices)
          sum += mesh.vertices[v];
        centres.push_back(sum / double(cell.vertices.size()));
      }
    const auto positions =
      Utilities::inverse_Hilbert_space_filling_curve<3>(centres, 20);
    std::vector<std::size_t> order(mesh.cells.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(),
                     order.end(),
                     [&](const auto a, const auto b) {
                       return positions[a] < positions[b];
                     });

    std::vector<CellData<3>> cells;
    std::vector<Point<3>>    nodes;
    for (const std::size_t cell : order)
      {
        cells.push_back(mesh.cells[cell]);
        if (mesh.geometry != nullptr)
          {
            const unsigned int n = mesh.geometry->nodes_per_cell;
            nodes.insert(nodes.end(),
                         mesh.geometry->nodes.begin() + n * cell,
                         mesh.geometry->nodes.begin() + n * (cell + 1));
          }
      }
    mesh.cells = std::move(cells);
    if (mesh.geometry != nullptr)
      mesh.geometry =
        std::make_shared<CoarseGeometry>(mesh.geometry->nodes_per_cell, nodes);
  }
} // namespace mortise
