// See row_assembler.h.
#include <deal.II/base/mpi.h>

#include <mortise/mortar/row_assembler.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using GlobalIndex = types::global_dof_index;

    void
    make_unique(std::vector<GlobalIndex> &indices)
    {
      std::sort(indices.begin(), indices.end());
      indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
    }
  } // namespace

  RowAssembler::RowAssembler(const IndexSet &rows, const IndexSet &columns)
    : rows(rows)
    , columns(columns)
    , number_of_owned(rows.n_elements(), -1)
  {}

  int
  RowAssembler::find(const Index row) const
  {
    if (rows.is_element(row))
      return number_of_owned[rows.index_within_set(row)];
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
    if (rows.is_element(row))
      number_of_owned[rows.index_within_set(row)] = static_cast<int>(number);
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
    make_unique(sets.back());
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
            make_unique(patterns.back());
          }
        pattern_of.push_back(patterns.size() - 1);
        begin.push_back(n_values);
        n_values += patterns.back().size();
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
    const unsigned int       n_rows    = transposed ? block.n() : block.m();
    const unsigned int       n_columns = transposed ? block.m() : block.n();
    const unsigned int      *at        = &column.begin[column.offset];
    const unsigned int       first     = at[0];
    const std::vector<Index> wanted(column.index.begin() + first,
                                    column.index.begin() + at[n_columns]);
    std::vector<double>      sums(wanted.size());
    const std::vector<unsigned int> *positions  = nullptr;
    unsigned int                     n_patterns = 0;
    int                              pattern    = -1; // that the places are in
    for (unsigned int i = 0; i < n_rows; ++i)
      {
        for (unsigned int j = 0; j < n_columns; ++j)
          for (unsigned int e = at[j]; e < at[j + 1]; ++e)
            sums[e - first] =
              column.weight[e] * (transposed ? block(j, i) : block(i, j));
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
            const double scale = factor * row.weight[e];
            double      *to    = values.data() + begin[r];
            for (unsigned int k = 0; k < sums.size(); ++k)
              to[(*positions)[k]] += scale * sums[k];
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
  RowAssembler::create(const MPI_Comm comm, const unsigned int n_components)
  {
    if (Utilities::MPI::n_mpi_processes(comm) > 1)
      {
        std::vector<SparseMatrix::Entry> entries;
        entries.reserve(values.size());
        const auto add = [&](const Index row, const int r) {
          std::size_t k = r < 0 ? 0 : begin[r];
          if (r >= 0)
            for (const Index column : patterns[pattern_of[r]])
              entries.push_back({row, column, values[k++]});
        };
        for (const Index row : rows)
          add(row, number_of_owned[rows.index_within_set(row)]);
        for (const auto &[row, r] : number_of_other)
          add(row, static_cast<int>(r));
        return {
          rows, columns, comm, entries, VectorOperation::add, n_components};
      }
    SparseMatrix::CompressedRows result;
    for (const int r : number_of_owned)
      {
        if (r >= 0)
          {
            const auto &pattern = patterns[pattern_of[r]];
            const auto  first   = values.begin() + begin[r];
            result.columns.insert(result.columns.end(),
                                  pattern.begin(),
                                  pattern.end());
            result.values.insert(result.values.end(),
                                 first,
                                 first + pattern.size());
          }
        result.begin.push_back(result.columns.size());
      }
    return {rows, columns, comm, std::move(result), n_components};
  }
} // namespace mortise
