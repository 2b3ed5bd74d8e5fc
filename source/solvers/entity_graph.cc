// See entity_graph.h.
#include <mortise/solvers/entity_graph.h>
#include <mortise/solvers/epetra_tools.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <set>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    void
    sort_and_remove_duplicates(std::vector<int> &list)
    {
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
    }

    bool
    contains(const std::vector<int> &larger, const std::vector<int> &smaller)
    {
      return std::includes(larger.begin(), larger.end(), smaller.begin(), smaller.end());
    }
  } // namespace

  EntityGraph::EntityGraph(const BlockSystem &system)
  {
    const auto n_blocks = static_cast<int>(system.entity_blocks.size());
    const auto counts   = Utilities::MPI::all_gather(system.communicator, n_blocks);
    const auto rank     = Utilities::MPI::this_mpi_process(system.communicator);
    rank_start.assign(1, 0);
    for (const int count : counts)
      rank_start.push_back(rank_start.back() + count);
    first_block = rank_start[rank];

    const auto first = first_displacement(system);
    block_of_dof.assign(system.owned_displacement.n_elements(), -1);
    for (int b = 0; b < n_blocks; ++b)
      for (const auto i : system.entity_blocks[b])
        block_of_dof[i - first] = first_block + b;
    vertex.assign(n_blocks, false);
    for (const auto i : system.vertex_dofs)
      vertex[block_of_dof[i - first] - first_block] = true;
    connect(system);
    find_interiors(system);
    fetch_ghosts(system);
  }

  void
  EntityGraph::connect(const BlockSystem &system)
  {
    const auto n_blocks = system.entity_blocks.size();
    const auto first    = first_displacement(system);
    neighbors.assign(n_blocks, {});
    jump_neighbors.assign(n_blocks, {});
    bool is_jump = false;
    for (const auto *matrix : summands_of_bulk(system))
      {
        const std::vector<int> column_block = on_columns(*matrix, block_of_dof);
        for (unsigned int b = 0; b < n_blocks; ++b)
          {
            auto &list = is_jump ? jump_neighbors[b] : neighbors[b];
            list.push_back(first_block + b);
            for (const auto i : system.entity_blocks[b])
              {
                const EpetraRow row(*matrix, static_cast<int>(i - first));
                for (int k = 0; k < row.length; ++k)
                  if (const int other = column_block[row.columns[k]];
                      other != list.back() && row.values[k] != 0.)
                    list.push_back(other);
                // The rows of a block repeat its neighbours.
                if (list.size() > 10000)
                  sort_and_remove_duplicates(list);
              }
            sort_and_remove_duplicates(list);
          }
        is_jump = true;
      }
    for (unsigned int b = 0; b < n_blocks; ++b)
      if (jump_neighbors[b].size() > 1)
        {
          neighbors[b].insert(neighbors[b].end(), jump_neighbors[b].begin(), jump_neighbors[b].end());
          sort_and_remove_duplicates(neighbors[b]);
        }
  }

  void
  EntityGraph::find_interiors(const BlockSystem &system)
  {
    const auto       n_blocks = neighbors.size();
    const auto       first    = first_displacement(system);
    std::vector<int> candidate(block_of_dof.size(), 0);
    interior.assign(n_blocks, false);
    for (unsigned int b = 0; b < n_blocks; ++b)
      {
        // What a block of another rank sees is not known here; the cell's own interior, vertices,
        // edges and faces that are owned settle it.
        interior[b] = !vertex[b] && std::all_of(neighbors[b].begin(), neighbors[b].end(), [&](const int o) {
          return !is_owned(o) || contains(neighbors[o - first_block], neighbors[b]);
        });
        if (interior[b])
          for (const auto i : system.entity_blocks[b])
            candidate[i - first] = system.entity_blocks[b].size();
      }

    // A face on the boundary is seen by one cell only, too: of two neighbours the larger block is
    // taken.
    const std::vector<bool> is_candidate = interior;
    for (const auto *matrix : summands_of_bulk(system))
      {
        const std::vector<int> column_block     = on_columns(*matrix, block_of_dof);
        const std::vector<int> column_candidate = on_columns(*matrix, candidate);
        for (unsigned int b = 0; b < n_blocks; ++b)
          if (is_candidate[b])
            for (const auto i : system.entity_blocks[b])
              {
                const EpetraRow row(*matrix, static_cast<int>(i - first));
                const int       mine = first_block + static_cast<int>(b);
                const int       size = static_cast<int>(system.entity_blocks[b].size());
                for (int k = 0; k < row.length; ++k)
                  {
                    const int other      = column_block[row.columns[k]];
                    const int other_size = column_candidate[row.columns[k]];
                    if (other != mine && row.values[k] != 0. &&
                        (other_size > size || (other_size == size && other < mine)))
                      interior[b] = false;
                  }
              }
      }
  }

  void
  EntityGraph::fetch_ghosts(const BlockSystem &system)
  {
    std::map<unsigned int, std::vector<int>> requests;
    {
      std::set<int> wanted;
      for (unsigned int v = 0; v < neighbors.size(); ++v)
        if (vertex[v])
          for (const int o : neighbors[v])
            if (!is_owned(o))
              wanted.insert(o);
      for (const int o : wanted)
        requests[std::upper_bound(rank_start.begin(), rank_start.end(), o) - rank_start.begin() - 1]
          .push_back(o);
    }
    std::map<unsigned int, std::vector<std::pair<int, Ghost>>> answers;
    for (const auto &from : Utilities::MPI::some_to_some(system.communicator, requests))
      for (const int o : from.second)
        {
          const unsigned int b = o - first_block;
          answers[from.first].push_back(
            {o, {system.entity_blocks[b], neighbors[b], jump_neighbors[b], interior[b]}});
        }
    for (auto &from : Utilities::MPI::some_to_some(system.communicator, answers))
      for (auto &answer : from.second)
        ghosts.insert(std::move(answer));
  }

  std::vector<std::vector<types::global_dof_index>>
  EntityGraph::patches(const BlockSystem &system) const
  {
    std::vector<std::vector<types::global_dof_index>> result;
    std::vector<bool>                                 covered(interior);
    const auto belongs = [&](const unsigned int      v,
                             const std::vector<int> &around,
                             const std::vector<int> &jump_around) {
      return contains(neighbors[v], around) ||
             (jump_around.size() > 1 && contains(jump_neighbors[v], jump_around));
    };
    for (unsigned int v = 0; v < neighbors.size(); ++v)
      if (vertex[v])
        {
          result.emplace_back();
          auto &patch = result.back();
          for (const int o : neighbors[v])
            if (is_owned(o))
              {
                const unsigned int b = o - first_block;
                if (!interior[b] && belongs(v, neighbors[b], jump_neighbors[b]))
                  {
                    const auto &dofs = system.entity_blocks[b];
                    patch.insert(patch.end(), dofs.begin(), dofs.end());
                    covered[b] = true;
                  }
              }
            else if (const Ghost &ghost = ghosts.at(o);
                     !ghost.interior && belongs(v, ghost.neighbors, ghost.jump_neighbors))
              patch.insert(patch.end(), ghost.dofs.begin(), ghost.dofs.end());
        }
    for (unsigned int b = 0; b < neighbors.size(); ++b)
      if (!covered[b])
        result.push_back(system.entity_blocks[b]);
    return result;
  }
} // namespace mortise
