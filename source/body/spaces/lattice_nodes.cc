// See lattice_nodes.h.
#include <mortise/base/look_up.h>
#include <mortise/body/spaces/lattice_nodes.h>

#include <algorithm>
#include <map>
#include <set>

namespace mortise
{
  using namespace dealii;

  LatticeNodes::LatticeNodes(const NodalSpace        &vertices,
                             const Body              &body,
                             const LatticeCoarsening &lattice,
                             const MPI_Comm           comm)
  {
    if (lattice.n_steps() == 0)
      return;
    unsigned int n_vertices = 0;
    for (const LatticeBlock &block : body.mesh.lattice)
      for (const unsigned int vertex : block.vertices)
        n_vertices = std::max(n_vertices, vertex + 1);
    nodes.assign(n_vertices, numbers::invalid_dof_index);
    vertices.for_each_cell(
      [&](const Body &of, const auto &cell, const auto &of_cell) {
        if (of.index == body.index)
          for (const unsigned int v : cell->vertex_indices())
            if (const unsigned int vertex = cell->vertex_index(v);
                vertex < n_vertices)
              nodes[vertex] = of_cell[v];
      });
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(comm);
    if (n_ranks == 1)
      return;

    const IndexSet &owned    = vertices.owned_nodes();
    const auto      is_owned = [&](const unsigned int vertex) {
      return nodes[vertex] != numbers::invalid_dof_index &&
             owned.is_element(nodes[vertex]);
    };
    std::set<unsigned int>        asked;
    std::map<unsigned int, Index> known; // that others may ask for
    for (unsigned int step = 0; step < lattice.n_steps(); ++step)
      lattice.for_each(step,
                       [&](const unsigned int vertex, const auto &entries) {
                         const bool mine = is_owned(vertex);
                         for (const auto &entry : entries)
                           if (mine &&
                               nodes[entry.first] == numbers::invalid_dof_index)
                             asked.insert(entry.first);
                           else if (!mine && is_owned(entry.first))
                             known.emplace(entry.first, nodes[entry.first]);
                       });
    for (const auto &[vertex, node] : look_up(
           asked,
           known,
           [&](const std::size_t key) {
             return static_cast<unsigned int>(key * n_ranks / n_vertices);
           },
           comm))
      nodes[vertex] = node;
  }
} // namespace mortise
