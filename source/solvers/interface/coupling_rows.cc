// See coupling_rows.h.
#include <mortise/solvers/epetra_tools.h>
#include <mortise/solvers/interface/coupling_rows.h>

#include <algorithm>

namespace mortise
{
  CouplingColumns::CouplingColumns(const CouplingMatrix &B)
    : node_of_column(B.scalar().NumMyCols(), -1)
  {
    const Epetra_CrsMatrix &matrix = B.scalar();
    // the columns of a rank alone are those of all nodes
    std::vector<bool> has_entries(matrix.NumMyCols());
    for (const RowGroup &group : group_rows(matrix))
      {
        const EpetraRow row(matrix, group.first);
        for (int k = 0; k < row.length; ++k)
          has_entries[row.columns[k]] = true;
      }
    std::vector<std::pair<int, int>> nodes; // and columns
    for (int k = 0; k < matrix.NumMyCols(); ++k)
      if (has_entries[k])
        nodes.emplace_back(matrix.GCID(k), k);
    std::sort(nodes.begin(), nodes.end());
    const std::vector<double> ones(dim * matrix.DomainMap().NumMyElements(),
                                   1.);
    const Epetra_MultiVector  is_free = B.on_columns(ones.data());
    for (const auto &[node, column] : nodes)
      {
        node_of_column[column] = static_cast<int>(n_nodes++);
        for (unsigned int c = 0; c < dim; ++c)
          displacements.push_back(is_free[c][column] != 0. ?
                                    static_cast<int>(dim) * node +
                                      static_cast<int>(c) :
                                    -1);
      }
  }

  namespace
  {
    /// The nodes of a row in ascending order, and their index in it.
    std::vector<std::pair<unsigned int, int>>
    sorted_nodes(const EpetraRow &row, const CouplingColumns &moved)
    {
      std::vector<std::pair<unsigned int, int>> result(row.length);
      for (int k = 0; k < row.length; ++k)
        result[k] = {moved.node_of_column[row.columns[k]], k};
      if (!std::is_sorted(result.begin(), result.end()))
        std::sort(result.begin(), result.end());
      return result;
    }

    using RowsOfComponents = std::array<int, dim>;

    /// Are @p rows those behind the last of @p shared?
    bool
    follow(const SharedRows &shared, const RowsOfComponents &rows)
    {
      for (unsigned int c = 0; c < dim; ++c)
        if (const int first = shared.first_row[c];
            rows[c] != (first < 0 ? -1 : first + shared.n_rows))
          return false;
      return true;
    }
  } // namespace

  CouplingRows::CouplingRows(const CouplingMatrix &B)
    : matrix(B)
    , moved(B)
    , multipliers(B)
    , rows(multipliers.entities.size())
  {
    const Epetra_CrsMatrix       &scalar = B.scalar();
    std::vector<RowsOfComponents> sharing(scalar.NumMyRows(), {{-1, -1, -1}});
    for (int i = 0; i < scalar.NumMyRows(); ++i)
      sharing[B.representative(i)][B.component(i)] = i;
    unsigned int e = 0;
    for (const RowGroup &group : group_rows(scalar))
      {
        const auto  nodes  = sorted_nodes({scalar, group.first}, moved);
        SharedRows *shared = nullptr;
        for (int i = group.first; i < group.first + group.n_rows; ++i)
          {
            if (B.representative(i) != i)
              continue;
            while (i >= multipliers.entities[e].first_row +
                          multipliers.entities[e].n_rows)
              {
                ++e;
                shared = nullptr;
              }
            if (shared == nullptr || !follow(*shared, sharing[i]))
              {
                shared             = &rows[e].emplace_back();
                shared->first_node = multipliers.node_of_row[i];
                shared->first_row  = sharing[i];
                for (const auto &[node, k] : nodes)
                  shared->nodes.push_back(node);
              }
            const EpetraRow row(scalar, i);
            for (const auto &[node, k] : nodes)
              shared->values.push_back(row.values[k]);
            ++shared->n_rows;
          }
      }
  }
} // namespace mortise
