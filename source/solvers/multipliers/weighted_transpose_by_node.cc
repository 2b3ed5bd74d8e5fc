// See weighted_transpose_by_node.h.
#include <mortise/solvers/multipliers/weighted_transpose_by_node.h>

#include <algorithm>
#include <array>

namespace mortise
{
  WeightedTransposeByNode::WeightedTransposeByNode(WeightedTranspose   source,
                                                   const RowsByEntity &B,
                                                   const NodeNumbers  &numbers)
    : is_common(B.n_nodes())
    , row_of(dim * B.n_nodes(), -1)
    , begin{0}
    , components(numbers.global.size())
  {
    std::vector<Row> rows(dim * B.n_nodes());
    for (unsigned int v = 0; v < rows.size(); ++v)
      {
        Entry *const first = source.entries.data() + source.begin[v],
                     *last = source.entries.data() + source.begin[v + 1];
        if (std::all_of(first, last, [](const Entry &entry) {
              return entry.second == 0.;
            }))
          continue; // multipliers do not move it
        for (Entry *entry = first; entry != last; ++entry)
          {
            entry->first = numbers.of_column[entry->first];
            components[entry->first] |= 1 << v % dim;
          }
        if (!std::is_sorted(first, last))
          std::sort(first, last);
        rows[v] = {first, last};
      }

    // rows of all components first
    nodes.reserve(source.entries.size());
    values.reserve(source.entries.size());
    std::vector<Entry> united;
    for (unsigned int i = 0; i < B.n_nodes(); ++i)
      if (unite(&rows[dim * i], united))
        {
          is_common[i] = true;
          if (united.empty())
            continue;
          for (unsigned int c = 0; c < dim; ++c)
            row_of[dim * i + c] = begin.size() - 1;
          add_row({united.data(), united.data() + united.size()});
        }
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int i = 0; i < B.n_nodes(); ++i)
        if (const unsigned int v = dim * i + c;
            !is_common[i] && B.displacements[v] >= 0)
          {
            row_of[v] = begin.size() - 1;
            add_row(rows[v]);
          }
  }

  bool
  WeightedTransposeByNode::unite(const Row          *rows,
                                 std::vector<Entry> &united) const
  {
    united.clear();
    std::array<const Entry *, dim> at;
    for (unsigned int c = 0; c < dim; ++c)
      at[c] = rows[c].first;
    for (;;)
      {
        int node = -1;
        for (unsigned int c = 0; c < dim; ++c)
          if (at[c] != rows[c].last && (node < 0 || at[c]->first < node))
            node = at[c]->first;
        if (node < 0)
          return true;
        bool is_new = true;
        for (unsigned int c = 0; c < dim; ++c)
          if (at[c] != rows[c].last && at[c]->first == node)
            {
              if (is_new)
                united.push_back(*at[c]);
              else if (at[c]->second != united.back().second)
                return false;
              is_new = false;
              ++at[c];
            }
          else if (has_multiplier(node, c))
            return false;
      }
  }

  void
  WeightedTransposeByNode::add_row(const Row &row)
  {
    for (const Entry *entry = row.first; entry != row.last; ++entry)
      {
        nodes.push_back(entry->first);
        values.push_back(entry->second);
      }
    begin.push_back(nodes.size());
    const unsigned int r = begin.size() - 2;
    group_of.push_back(r > 0 && same_nodes(r - 1, r) ? group_of.back() : r);
  }
} // namespace mortise
