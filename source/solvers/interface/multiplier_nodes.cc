// See multiplier_nodes.h.
#include <deal.II/base/exceptions.h>

#include <Epetra_Import.h>
#include <Epetra_IntVector.h>
#include <mortise/base/types.h>
#include <mortise/solvers/interface/multiplier_nodes.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Which component's displacements the rows of @p group move.
    unsigned int
    component_of(const Epetra_CrsMatrix &B, const RowGroup &group)
    {
      const EpetraRow row(B, group.first);
      for (int k = 1; k < row.length; ++k)
        Assert(B.GCID(row.columns[k]) % dim == B.GCID(row.columns[0]) % dim,
               ExcInternalError());
      return row.length > 0 ? B.GCID(row.columns[0]) % dim : 0;
    }
  } // namespace

  std::vector<EntityNodes>
  group_by_entity(const Epetra_CrsMatrix &B)
  {
    std::vector<EntityNodes> entities;
    unsigned int             last = dim;
    int                      next = 0; // node of this component
    for (const RowGroup &group : group_rows(B))
      {
        const unsigned int component = component_of(B, group);
        if (entities.empty() || component < last)
          {
            const int first = entities.empty() ?
                                0 :
                                entities.back().first + entities.back().n_nodes;
            entities.push_back({first, 0, {}});
          }
        EntityNodes &entity = entities.back();
        if (entity.groups.empty() || component != last)
          next = entity.first;
        entity.groups.push_back({group, next, component});
        next += group.n_rows;
        entity.n_nodes = std::max(entity.n_nodes, next - entity.first);
        last           = component;
      }
    return entities;
  }

  NodeNumbers
  number_nodes(const std::vector<EntityNodes> &entities,
               const Epetra_Map               &rows,
               const Epetra_BlockMap          &columns)
  {
    const int n_owned =
      entities.empty() ? 0 : entities.back().first + entities.back().n_nodes;
    int first = 0;
    rows.Comm().ScanSum(const_cast<int *>(&n_owned), &first, 1);
    first -= n_owned;
    Epetra_IntVector owned(rows), all(columns);
    for (const EntityNodes &entity : entities)
      for (const NodeGroup &group : entity.groups)
        for (int i = 0; i < group.rows.n_rows; ++i)
          owned[group.rows.first + i] = first + group.node + i;
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
