// See node_transpose.h.
#include <mortise/solvers/epetra_tools.h>
#include <mortise/solvers/node_transpose.h>

#include <algorithm>
#include <array>

namespace mortise
{
  NodeTranspose::NodeTranspose(const Epetra_CrsMatrix &matrix,
                               const CouplingRows     &B,
                               const NodeNumbers      &numbers)
    : is_common(B.moved.n_nodes)
    , row_of(dim * B.moved.n_nodes, -1)
    , begin{0}
    , components(numbers.global.size())
  {
    std::vector<Row> rows(dim * B.moved.n_nodes);
    for (unsigned int v = 0; v < rows.size(); ++v)
      if (const int column = B.moved.column_of_value[v]; column >= 0)
        {
          const EpetraRow entries(matrix, matrix.LRID(B.matrix.GCID(column)));
          if (std::all_of(entries.values,
                          entries.values + entries.length,
                          [](const double value) { return value == 0.; }))
            continue; // multipliers do not move it
          rows[v].reserve(entries.length);
          for (int k = 0; k < entries.length; ++k)
            {
              const int node = numbers.of_column[entries.columns[k]];
              rows[v].emplace_back(node, entries.values[k]);
              components[node] |= 1 << v % dim;
            }
          std::sort(rows[v].begin(), rows[v].end());
        }

    // rows of all components first
    Row united;
    for (unsigned int i = 0; i < B.moved.n_nodes; ++i)
      if (unite(&rows[dim * i], united))
        {
          is_common[i] = true;
          if (united.empty())
            continue;
          for (unsigned int c = 0; c < dim; ++c)
            row_of[dim * i + c] = begin.size() - 1;
          add_row(united);
        }
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int i = 0; i < B.moved.n_nodes; ++i)
        if (const unsigned int v = dim * i + c;
            !is_common[i] && B.moved.column_of_value[v] >= 0)
          {
            row_of[v] = begin.size() - 1;
            add_row(rows[v]);
          }
  }

  bool
  NodeTranspose::unite(const Row *rows, Row &united) const
  {
    united.clear();
    std::array<std::size_t, dim> at = {};
    for (;;)
      {
        int node = -1;
        for (unsigned int c = 0; c < dim; ++c)
          if (at[c] < rows[c].size() &&
              (node < 0 || rows[c][at[c]].first < node))
            node = rows[c][at[c]].first;
        if (node < 0)
          return true;
        bool is_new = true;
        for (unsigned int c = 0; c < dim; ++c)
          if (at[c] < rows[c].size() && rows[c][at[c]].first == node)
            {
              if (is_new)
                united.push_back(rows[c][at[c]]);
              else if (rows[c][at[c]].second != united.back().second)
                return false;
              is_new = false;
              ++at[c];
            }
          else if (has_multiplier(node, c))
            return false;
      }
  }

  void
  NodeTranspose::add_row(const Row &row)
  {
    for (const auto &[node, value] : row)
      {
        nodes.push_back(node);
        values.push_back(value);
      }
    begin.push_back(nodes.size());
    const unsigned int r = begin.size() - 2;
    group_of.push_back(r > 0 && same_nodes(r - 1, r) ? group_of.back() : r);
  }

  bool
  NodeTranspose::same_nodes(const unsigned int r, const unsigned int s) const
  {
    return std::equal(nodes.begin() + begin[r],
                      nodes.begin() + begin[r + 1],
                      nodes.begin() + begin[s],
                      nodes.begin() + begin[s + 1]);
  }
} // namespace mortise
