// See coupling_rows.h.
#include <mortise/solvers/epetra_tools.h>
#include <mortise/solvers/interface/coupling_rows.h>
#include <mortise/solvers/interface/multiplier_nodes.h>

#include <algorithm>

namespace mortise
{
  namespace
  {
    /// The columns of a row: the node that each belongs to, in ascending order,
    /// and its index in the row.
    using Columns = std::vector<std::pair<unsigned int, int>>;

    Columns
    columns_by_node(const EpetraRow &row, const CouplingColumns &moved)
    {
      Columns result(row.length);
      for (int k = 0; k < row.length; ++k)
        result[k] = {moved.value_of_column[row.columns[k]] / moved.n_components,
                     k};
      if (!std::is_sorted(result.begin(), result.end()))
        std::sort(result.begin(), result.end());
      return result;
    }

    /// Rows of the same nodes for components that share their entries.
    class Sharing
    {
    public:
      Sharing(const Epetra_CrsMatrix &matrix,
              const CouplingColumns  &moved,
              const NodeGroup        &group)
        : matrix(matrix)
        , moved(moved)
      {
        rows.first_node = group.node;
        rows.n_rows     = group.rows.n_rows;
        add(group);
      }

      /// Takes in another component, unless its entries differ.
      bool
      add(const NodeGroup &group)
      {
        if (group.node != rows.first_node || group.rows.n_rows != rows.n_rows)
          return false;
        const Columns columns =
          columns_by_node(EpetraRow(matrix, group.rows.first), moved);
        if (!unite(columns, group.component) || !compare(columns, group))
          return false;
        if (united.size() > rows.nodes.size())
          widen(columns, group);
        rows.first_row[group.component] = group.rows.first;
        return true;
      }

      SharedRows rows;

    private:
      /// The nodes of both; false if one lacks a node that is moved.
      bool
      unite(const Columns &columns, const unsigned int component)
      {
        const auto       &nodes = rows.nodes;
        const std::size_t n     = nodes.size();
        united.clear();
        before.clear();
        indices.clear();
        united.reserve(n + columns.size());
        before.reserve(n + columns.size());
        indices.reserve(columns.size());
        const auto lacking = [&](const unsigned int node) {
          return moved.column_of_value[moved.n_components * node + component] <
                 0;
        };
        const auto lacking_before = [&](const unsigned int node) {
          for (unsigned int c = 0; c < moved.n_components; ++c)
            if (rows.first_row[c] >= 0 &&
                moved.column_of_value[moved.n_components * node + c] >= 0)
              return false;
          return true;
        };
        for (std::size_t i = 0, k = 0; i < n || k < columns.size();)
          {
            const bool old =
              i < n && (k == columns.size() || nodes[i] <= columns[k].first);
            const unsigned int node = old ? nodes[i] : columns[k].first;
            if (k < columns.size() && columns[k].first == node)
              {
                indices.push_back(united.size());
                ++k;
              }
            else if (!lacking(node))
              return false;
            if (!old && !lacking_before(node))
              return false;
            united.push_back(node);
            before.push_back(old ? static_cast<int>(i++) : -1);
          }
        return true;
      }

      /// Are the entries of nodes that both have the same?
      bool
      compare(const Columns &columns, const NodeGroup &group) const
      {
        for (int r = 0; r < rows.n_rows; ++r)
          {
            const double   *known = rows.values.data() + r * rows.nodes.size();
            const EpetraRow row(matrix, group.rows.first + r);
            for (std::size_t k = 0; k < columns.size(); ++k)
              if (const int index = before[indices[k]];
                  index >= 0 && known[index] != row.values[columns[k].second])
                return false;
          }
        return true;
      }

      /// Takes in the nodes that are new.
      void
      widen(const Columns &columns, const NodeGroup &group)
      {
        const std::size_t   n = rows.nodes.size(), m = united.size();
        std::vector<double> values(rows.n_rows * m);
        for (int r = 0; r < rows.n_rows; ++r)
          {
            double *const to = values.data() + r * m;
            for (std::size_t l = 0; l < m; ++l)
              if (before[l] >= 0)
                to[l] = rows.values[r * n + before[l]];
            const EpetraRow row(matrix, group.rows.first + r);
            for (std::size_t k = 0; k < columns.size(); ++k)
              to[indices[k]] = row.values[columns[k].second];
          }
        rows.nodes.swap(united);
        rows.values.swap(values);
      }

      const Epetra_CrsMatrix   &matrix;
      const CouplingColumns    &moved;
      std::vector<unsigned int> united; ///< nodes
      std::vector<int> before; ///< indices among the nodes of rows; -1: new
      std::vector<unsigned int> indices; ///< in united, by column
    };
  } // namespace

  CouplingColumns::CouplingColumns(const Epetra_CrsMatrix &B,
                                   const unsigned int      n_components)
    : n_components(n_components)
    , value_of_column(B.NumMyCols(), -1)
  {
    const auto node_of = [&](const int column) {
      return B.GCID(column) / static_cast<int>(n_components);
    };
    // the columns of a rank alone are those of all displacements
    std::vector<bool> has_entries(B.NumMyCols());
    for (const RowGroup &group : group_rows(B))
      {
        const EpetraRow row(B, group.first);
        for (int k = 0; k < row.length; ++k)
          has_entries[row.columns[k]] = true;
      }
    std::vector<int> nodes;
    for (int k = 0; k < B.NumMyCols(); ++k)
      if (has_entries[k])
        nodes.push_back(node_of(k));
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    n_nodes = nodes.size();
    column_of_value.resize(n_components * n_nodes, -1);
    for (int k = 0; k < B.NumMyCols(); ++k)
      if (has_entries[k])
        {
          const auto index =
            std::lower_bound(nodes.begin(), nodes.end(), node_of(k));
          value_of_column[k] =
            n_components * (index - nodes.begin()) + B.GCID(k) % n_components;
          column_of_value[value_of_column[k]] = k;
        }
  }

  CouplingRows::CouplingRows(const Epetra_CrsMatrix &B, const bool by_node)
    : matrix(B)
    , moved(B, by_node ? dim : 1)
  {
    if (by_node)
      entities = group_by_entity(B);
    else
      for (const RowGroup &group : group_rows(B))
        entities.push_back(
          {group.first, group.n_rows, {{group, group.first, 0}}});
    for (const EntityNodes &entity : entities)
      {
        std::vector<Sharing> sharings;
        for (const NodeGroup &group : entity.groups)
          if (std::none_of(sharings.begin(),
                           sharings.end(),
                           [&](Sharing &sharing) {
                             return sharing.add(group);
                           }))
            sharings.emplace_back(B, moved, group);
        rows.emplace_back();
        for (Sharing &sharing : sharings)
          rows.back().push_back(std::move(sharing.rows));
      }
  }
} // namespace mortise
