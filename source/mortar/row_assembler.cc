// See row_assembler.h.
#include <deal.II/base/mpi.h>

#include <mortise/base/sort_unique.h>
#include <mortise/mortar/row_assembler.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  RowAssembler::RowAssembler(const IndexSet    &rows,
                             const IndexSet    &columns,
                             const unsigned int n_components)
    : rows(rows)
    , columns(columns)
    , n_components(n_components)
    , nodes(nodes_of(rows, n_components))
    , number_of_owned(nodes.n_elements(), -1)
  {}

  int
  RowAssembler::find(const Index row) const
  {
    if (nodes.is_element(row))
      return number_of_owned[nodes.index_within_set(row)];
    const auto other = number_of_other.find(row);
    return other == number_of_other.end() ? -1 :
                                            static_cast<int>(other->second);
  }

  unsigned int
  RowAssembler::find_or_insert(const Index row)
  {
    const int known = find(row);
    if (known >= 0)
      return known;
    const unsigned int number = sets_of.size();
    sets_of.emplace_back();
    if (nodes.is_element(row))
      number_of_owned[nodes.index_within_set(row)] = static_cast<int>(number);
    else
      number_of_other[row] = number;
    return number;
  }

  void
  RowAssembler::record(const Expansion   &row,
                       const unsigned int n_rows,
                       const Expansion   &column,
                       const unsigned int n_columns)
  {
    sets.emplace_back();
    for (unsigned int e = column.begin[column.offset];
         e < column.begin[column.offset + n_columns];
         ++e)
      sets.back().push_back(column.index[e]);
    sort_unique(sets.back());
    const unsigned int set = sets.size() - 1;
    for (unsigned int e = row.begin[row.offset];
         e < row.begin[row.offset + n_rows];
         ++e)
      {
        auto &list = sets_of[find_or_insert(row.index[e])];
        if (list.empty() || list.back() != set)
          list.push_back(set);
      }
  }

  void
  RowAssembler::allocate()
  {
    std::size_t n_values = 0;
    for (unsigned int r = 0; r < sets_of.size(); ++r)
      {
        // neighbours mostly have the same
        if (r == 0 || sets_of[r] != sets_of[r - 1])
          {
            patterns.emplace_back();
            for (const unsigned int set : sets_of[r])
              patterns.back().insert(patterns.back().end(),
                                     sets[set].begin(),
                                     sets[set].end());
            sort_unique(patterns.back());
          }
        pattern_of.push_back(patterns.size() - 1);
        begin.push_back(n_values);
        n_values += n_components * n_components * patterns.back().size();
      }
    values.resize(n_values);
    sets    = {};
    sets_of = {};
  }

  void
  RowAssembler::add(const Expansion          &row,
                    const Expansion          &column,
                    const FullMatrix<double> &block,
                    const double              factor,
                    const bool                transposed)
  {
    const unsigned int n_rows =
                         (transposed ? block.n() : block.m()) / n_components,
                       n_columns =
                         (transposed ? block.m() : block.n()) / n_components;
    const unsigned int      *at    = &column.begin[column.offset];
    const unsigned int       first = at[0];
    const std::vector<Index> wanted(column.index.begin() + first,
                                    column.index.begin() + at[n_columns]);
    // by component of the row, and column
    std::vector<double> sums(n_components * n_components * wanted.size());
    const std::vector<unsigned int> *positions  = nullptr;
    unsigned int                     n_patterns = 0;
    int                              pattern    = -1; // that the places are in
    for (unsigned int i = 0; i < n_rows; ++i)
      {
        double *sum = sums.data();
        for (unsigned int c = 0; c < n_components; ++c)
          for (unsigned int j = 0; j < n_columns; ++j)
            for (unsigned int e = at[j]; e < at[j + 1]; ++e)
              for (unsigned int d = 0; d < n_components; ++d)
                {
                  const unsigned int a = c * n_rows + i, b = d * n_columns + j;
                  *sum++ =
                    column.weight[e] * (transposed ? block(b, a) : block(a, b));
                }
        for (unsigned int e = row.begin[row.offset + i];
             e < row.begin[row.offset + i + 1];
             ++e)
          {
            const unsigned int r = find(row.index[e]);
            if (static_cast<int>(pattern_of[r]) != pattern)
              {
                pattern = static_cast<int>(pattern_of[r]);
                positions =
                  &find_positions(wanted, patterns[pattern], n_patterns++);
              }
            const double  scale = factor * row.weight[e];
            double       *to    = values.data() + begin[r];
            const double *from  = sums.data();
            for (unsigned int c = 0; c < n_components; ++c)
              {
                for (const unsigned int position : *positions)
                  for (unsigned int d = 0; d < n_components; ++d)
                    to[n_components * position + d] += scale * *from++;
                to += n_components * patterns[pattern].size();
              }
          }
      }
  }

  const std::vector<unsigned int> &
  RowAssembler::find_positions(const std::vector<Index> &wanted,
                               const std::vector<Index> &pattern,
                               const unsigned int        guess)
  {
    if (guess == guesses.size())
      guesses.emplace_back();
    auto &positions = guesses[guess];
    positions.resize(wanted.size());
    for (unsigned int k = 0; k < wanted.size(); ++k)
      if (positions[k] >= pattern.size() || pattern[positions[k]] != wanted[k])
        positions[k] =
          std::lower_bound(pattern.begin(), pattern.end(), wanted[k]) -
          pattern.begin();
    return positions;
  }

  SparseMatrix
  RowAssembler::create(const MPI_Comm comm, const unsigned int n_shared)
  {
    // visit(row, columns, values) for those of a node
    const auto for_each_row =
      [this](const Index node, const int r, const auto &visit) {
        std::vector<Index> of_row;
        if (r >= 0)
          for (const Index column : patterns[pattern_of[r]])
            for (unsigned int d = 0; d < n_components; ++d)
              of_row.push_back(n_components * column + d);
        for (unsigned int c = 0; c < n_components; ++c)
          visit(n_components * node + c,
                of_row,
                r < 0 ? nullptr : values.data() + begin[r] + c * of_row.size());
      };
    if (Utilities::MPI::n_mpi_processes(comm) > 1)
      {
        std::vector<SparseMatrix::Entry> entries;
        entries.reserve(values.size());
        const auto add = [&](const Index               row,
                             const std::vector<Index> &of_row,
                             const double             *from) {
          for (const Index column : of_row)
            entries.push_back({row, column, *from++});
        };
        for (const Index node : nodes)
          for_each_row(node,
                       number_of_owned[nodes.index_within_set(node)],
                       add);
        for (const auto &[node, r] : number_of_other)
          for_each_row(node, static_cast<int>(r), add);
        return {rows, columns, comm, entries, VectorOperation::add, n_shared};
      }
    SparseMatrix::CompressedRows result;
    result.columns.reserve(values.size());
    result.values.reserve(values.size());
    for (const Index node : nodes)
      for_each_row(
        node,
        number_of_owned[nodes.index_within_set(node)],
        [&](const Index, const std::vector<Index> &of_row, const double *from) {
          result.columns.insert(result.columns.end(),
                                of_row.begin(),
                                of_row.end());
          result.values.insert(result.values.end(), from, from + of_row.size());
          result.begin.push_back(result.columns.size());
        });
    return {rows, columns, comm, std::move(result), n_shared};
  }
} // namespace mortise
