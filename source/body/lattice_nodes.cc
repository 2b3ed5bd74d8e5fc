// See lattice_nodes.h.
#include <deal.II/base/mpi.h>

#include <boost/serialization/utility.hpp>

#include <mortise/body/lattice_nodes.h>

#include <algorithm>
#include <map>
#include <set>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// To the rank that brings together those who know and those who ask.
    struct VertexMessage
    {
      std::vector<unsigned int>                                 asked;
      std::vector<std::pair<unsigned int, LatticeNodes::Index>> known;

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive &asked &known;
      }
    };
  } // namespace

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
    std::set<unsigned int> asked, offered;
    for (unsigned int step = 0; step < lattice.n_steps(); ++step)
      lattice.for_each(step,
                       [&](const unsigned int vertex, const auto &entries) {
                         const bool mine = is_owned(vertex);
                         for (const auto &entry : entries)
                           if (mine &&
                               nodes[entry.first] == numbers::invalid_dof_index)
                             asked.insert(entry.first);
                           else if (!mine && is_owned(entry.first))
                             offered.insert(entry.first);
                       });
    const auto meeting_rank = [&](const std::size_t vertex) {
      return static_cast<unsigned int>(vertex * n_ranks / n_vertices);
    };
    std::map<unsigned int, VertexMessage> messages;
    for (const unsigned int vertex : asked)
      messages[meeting_rank(vertex)].asked.push_back(vertex);
    for (const unsigned int vertex : offered)
      messages[meeting_rank(vertex)].known.emplace_back(vertex, nodes[vertex]);
    const auto received = Utilities::MPI::some_to_some(comm, messages);
    std::map<unsigned int, Index> all_known;
    for (const auto &message : received)
      all_known.insert(message.second.known.begin(),
                       message.second.known.end());
    std::map<unsigned int, std::vector<Index>> answers;
    for (const auto &[rank, message] : received)
      for (const unsigned int vertex : message.asked)
        answers[rank].push_back(all_known.at(vertex));
    for (const auto &[rank, answer] :
         Utilities::MPI::some_to_some(comm, answers))
      for (unsigned int i = 0; i < answer.size(); ++i)
        nodes[messages[rank].asked[i]] = answer[i];
  }
} // namespace mortise
