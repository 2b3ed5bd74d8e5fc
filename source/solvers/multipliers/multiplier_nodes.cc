// See multiplier_nodes.h.
#include <mortise/solvers/multipliers/multiplier_nodes.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace mortise
{
  using namespace dealii;

  MultiplierNodes::MultiplierNodes(const CouplingMatrix &B)
  {
    unsigned int last = dim;
    int          next = 0; // node of this component
    for (int i = 0; i < static_cast<int>(B.scalar().n_rows()); ++i)
      {
        const unsigned int component = B.component(i);
        if (entities.empty() || component < last)
          entities.push_back({size(), 0, i, 0});
        EntityNodes &entity = entities.back();
        if (component != last)
          next = entity.first;
        // interfaces one after the other may look like one entity, in which
        // components that share rows are not at the same place
        if (const int same = static_cast<int>(B.representative(i)); same != i)
          next = node_of_row[same];
        node_of_row.push_back(next++);
        entity.n_nodes = std::max(entity.n_nodes, next - entity.first);
        ++entity.n_rows;
        last = component;
      }
  }

  NodeNumbers
  number_nodes(const MultiplierNodes                                    &nodes,
               const std::shared_ptr<const Utilities::MPI::Partitioner> &rows)
  {
    const int      n_owned = nodes.size();
    const IndexSet owned   = owned_range(n_owned, rows->get_mpi_communicator());
    const int      first =
      n_owned == 0 ? 0 : static_cast<int>(owned.nth_index_in_set(0));
    Vector all(rows); // node by row
    for (unsigned int i = 0; i < all.locally_owned_size(); ++i)
      all.local_element(i) = first + nodes.node_of_row[i];
    all.update_ghost_values();
    NodeNumbers numbers;
    numbers.global.resize(n_owned);
    std::iota(numbers.global.begin(), numbers.global.end(), first);
    std::map<int, int> others;
    for (unsigned int k = 0;
         k < rows->locally_owned_size() + rows->n_ghost_indices();
         ++k)
      if (const int node = static_cast<int>(all.local_element(k));
          node >= first && node < first + n_owned)
        numbers.of_column.push_back(node - first);
      else
        {
          const auto [other, is_new] =
            others.emplace(node, static_cast<int>(numbers.global.size()));
          if (is_new)
            numbers.global.push_back(node);
          numbers.of_column.push_back(other->second);
        }
    return numbers;
  }
} // namespace mortise
