// See entity_graph.h.
#include <deal.II/base/mpi.h>

#include <mortise/solvers/epetra_tools.h>
#include <mortise/solvers/multigrid/entity_graph.h>

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
      return std::includes(larger.begin(),
                           larger.end(),
                           smaller.begin(),
                           smaller.end());
    }
  } // namespace

  EntityGraph::EntityGraph(const BlockSystem &system)
  {
    const auto n_blocks = static_cast<int>(system.entity_blocks.size());
    const auto counts =
      Utilities::MPI::all_gather(system.communicator, n_blocks);
    const auto rank = Utilities::MPI::this_mpi_process(system.communicator);
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
          neighbors[b].insert(neighbors[b].end(),
                              jump_neighbors[b].begin(),
                              jump_neighbors[b].end());
          sort_and_remove_duplicates(neighbors[b]);
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
        requests[std::upper_bound(rank_start.begin(), rank_start.end(), o) -
                 rank_start.begin() - 1]
          .push_back(o);
    }
    std::map<unsigned int, std::vector<std::pair<int, Ghost>>> answers;
    for (const auto &from :
         Utilities::MPI::some_to_some(system.communicator, requests))
      for (const int o : from.second)
        {
          const unsigned int b = o - first_block;
          answers[from.first].push_back(
            {o, {system.entity_blocks[b], neighbors[b], jump_neighbors[b]}});
        }
    for (auto &from :
         Utilities::MPI::some_to_some(system.communicator, answers))
      for (auto &answer : from.second)
        ghosts.insert(std::move(answer));
  }

  std::vector<std::vector<types::global_dof_index>>
  EntityGraph::patches(const BlockSystem &system) const
  {
    std::vector<std::vector<types::global_dof_index>> result;
    std::vector<bool> covered(neighbors.size(), false);
    const auto        belongs = [&](const unsigned int      v,
                             const std::vector<int> &around,
                             const std::vector<int> &jump_around) {
      return contains(neighbors[v], around) ||
             (jump_around.size() > 1 &&
              contains(jump_neighbors[v], jump_around));
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
                if (belongs(v, neighbors[b], jump_neighbors[b]))
                  {
                    const auto &dofs = system.entity_blocks[b];
                    patch.insert(patch.end(), dofs.begin(), dofs.end());
                    covered[b] = true;
                  }
              }
            else if (const Ghost &ghost = ghosts.at(o);
                     belongs(v, ghost.neighbors, ghost.jump_neighbors))
              patch.insert(patch.end(), ghost.dofs.begin(), ghost.dofs.end());
        }
    for (unsigned int b = 0; b < neighbors.size(); ++b)
      if (!covered[b])
        result.push_back(system.entity_blocks[b]);
    return result;
  }
} // namespace mortise
