#include <deal.II/base/exceptions.h>

#include <metis.h>
#include <mortise/body/mesh/partition.h>

#include <algorithm>
#include <vector>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// The cells as METIS takes them: neighbours, and two weights per cell.
    struct Graph
    {
      Graph(const std::set<types::boundary_id> &boundaries,
            const Triangulation<3>             &triangulation)
      {
        begin.push_back(0);
        for (const auto &cell : triangulation.active_cell_iterators())
          {
            idx_t on_interface = 0;
            for (const unsigned int f : cell->face_indices())
              if (!cell->at_boundary(f))
                neighbours.push_back(cell->neighbor(f)->active_cell_index());
              else if (boundaries.count(cell->face(f)->boundary_id()) > 0)
                ++on_interface;
            begin.push_back(neighbours.size());
            weights.insert(weights.end(), {1, on_interface});
            any_on_interface = any_on_interface || on_interface > 0;
          }
      }

      std::vector<idx_t> begin, neighbours, weights;
      bool               any_on_interface = false;
    };
  } // namespace

  void
  partition_cells(const unsigned int                  n_parts,
                  const std::set<types::boundary_id> &boundaries,
                  Triangulation<3>                   &triangulation)
  {
    idx_t n_cells = triangulation.n_active_cells();
    // METIS does not take more parts than cells
    idx_t              parts = std::min<idx_t>(n_parts, n_cells);
    std::vector<idx_t> part(n_cells, 0);
    if (parts > 1)
      {
        Graph graph(boundaries, triangulation);
        idx_t n_balanced = graph.any_on_interface ? 2 : 1;
        if (n_balanced == 1)
          std::fill(graph.weights.begin(), graph.weights.end(), 1);
        idx_t     cut;
        const int result = METIS_PartGraphKway(&n_cells,
                                               &n_balanced,
                                               graph.begin.data(),
                                               graph.neighbours.data(),
                                               graph.weights.data(),
                                               nullptr,
                                               nullptr,
                                               &parts,
                                               nullptr,
                                               nullptr,
                                               nullptr,
                                               &cut,
                                               part.data());
        AssertThrow(result == METIS_OK,
                    ExcMessage("METIS could not partition the mesh"));
      }
    for (const auto &cell : triangulation.active_cell_iterators())
      cell->set_subdomain_id(part[cell->active_cell_index()]);
  }
} // namespace mortise
