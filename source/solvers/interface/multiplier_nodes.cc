// See multiplier_nodes.h.
#include <Epetra_Import.h>
#include <Epetra_IntVector.h>
#include <mortise/solvers/interface/multiplier_nodes.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace mortise
{
  MultiplierNodes::MultiplierNodes(const CouplingMatrix &B)
  {
    unsigned int last = dim;
    int          next = 0; // node of this component
    for (int i = 0; i < B.scalar().NumMyRows(); ++i)
      {
        const unsigned int component = B.component(i);
        if (entities.empty() || component < last)
          entities.push_back({size(), 0, i, 0});
        EntityNodes &entity = entities.back();
        if (component != last)
          next = entity.first;
        // interfaces one after the other may look like one entity, in which
        // components that share rows are not at the same place
        if (const int same = B.representative(i); same != i)
          next = node_of_row[same];
        node_of_row.push_back(next++);
        entity.n_nodes = std::max(entity.n_nodes, next - entity.first);
        ++entity.n_rows;
        last = component;
      }
  }

  NodeNumbers
  number_nodes(const MultiplierNodes &nodes,
               const Epetra_Map      &rows,
               const Epetra_BlockMap &columns)
  {
    const int n_owned = nodes.size();
    int       first   = 0;
    rows.Comm().ScanSum(const_cast<int *>(&n_owned), &first, 1);
    first -= n_owned;
    Epetra_IntVector owned(rows), all(columns);
    for (int i = 0; i < owned.MyLength(); ++i)
      owned[i] = first + nodes.node_of_row[i];
    all.Import(owned, Epetra_Import(columns, rows), Insert);
    NodeNumbers numbers;
    numbers.global.resize(n_owned);
    std::iota(numbers.global.begin(), numbers.global.end(), first);
    std::map<int, int> others;
    for (int k = 0; k < columns.NumMyElements(); ++k)
      if (all[k] >= first && all[k] < first + n_owned)
        numbers.of_column.push_back(all[k] - first);
      else
        {
          const auto [other, is_new] =
            others.emplace(all[k], static_cast<int>(numbers.global.size()));
          if (is_new)
            numbers.global.push_back(all[k]);
          numbers.of_column.push_back(other->second);
        }
    return numbers;
  }
} // namespace mortise
