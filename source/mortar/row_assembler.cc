// See row_assembler.h.
#include <deal.II/base/mpi.h>

#include <mortise/mortar/row_assembler.h>

#include <algorithm>
#include <numeric>

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

    /// Row, number of columns, columns of each row; values.
    using RowsOfOthers =
      std::pair<std::vector<GlobalIndex>, std::vector<double>>;
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
    const std::vector<unsigned int> *places     = nullptr;
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
                places  = &find_places(wanted, patterns[pattern], n_patterns++);
              }
            const double scale = factor * row.weight[e];
            double      *to    = values.data() + begin[r];
            for (unsigned int k = 0; k < sums.size(); ++k)
              to[(*places)[k]] += scale * sums[k];
          }
      }
  }

  const std::vector<unsigned int> &
  RowAssembler::find_places(const std::vector<Index> &wanted,
                            const std::vector<Index> &pattern,
                            const unsigned int        guess)
  {
    if (guess == guesses.size())
      guesses.emplace_back();
    auto &places = guesses[guess];
    places.resize(wanted.size());
    for (unsigned int k = 0; k < wanted.size(); ++k)
      if (places[k] >= pattern.size() || pattern[places[k]] != wanted[k])
        places[k] =
          std::lower_bound(pattern.begin(), pattern.end(), wanted[k]) -
          pattern.begin();
    return places;
  }

  void
  RowAssembler::add_from_others(const MPI_Comm comm)
  {
    std::vector<Index> ends =
      Utilities::MPI::all_gather(comm, Index(rows.n_elements()));
    std::partial_sum(ends.begin(), ends.end(), ends.begin());
    std::map<unsigned int, RowsOfOthers> packages;
    for (const auto &[row, r] : number_of_other)
      {
        auto &[indices, entries] =
          packages[std::upper_bound(ends.begin(), ends.end(), row) -
                   ends.begin()];
        const auto &list = patterns[pattern_of[r]];
        indices.push_back(row);
        indices.push_back(list.size());
        indices.insert(indices.end(), list.begin(), list.end());
        entries.insert(entries.end(),
                       values.begin() + begin[r],
                       values.begin() + begin[r] + list.size());
      }
    std::map<Index, Entries> shared;
    for (const auto &[rank, package] :
         Utilities::MPI::some_to_some(comm, packages))
      {
        auto index = package.first.begin();
        auto value = package.second.begin();
        while (index != package.first.end())
          {
            const Index row = *index++;
            const Index n   = *index++;
            Entries    &to  = shared[row];
            if (const int r = find(row); to.empty() && r >= 0)
              {
                const auto &list = patterns[pattern_of[r]];
                for (unsigned int k = 0; k < list.size(); ++k)
                  to.emplace_back(list[k], values[begin[r] + k]);
              }
            for (Index k = 0; k < n; ++k)
              to.emplace_back(*index++, *value++);
          }
      }
    for (auto &[row, entries] : shared)
      replace(row, entries);
  }

  void
  RowAssembler::replace(const Index row, Entries &entries)
  {
    std::stable_sort(entries.begin(),
                     entries.end(),
                     [](const auto &a, const auto &b) {
                       return a.first < b.first;
                     });
    int r = find(row);
    if (r < 0)
      {
        r                                           = pattern_of.size();
        number_of_owned[rows.index_within_set(row)] = r;
        pattern_of.push_back(0);
        begin.push_back(0);
      }
    pattern_of[r] = patterns.size();
    begin[r]      = values.size();
    patterns.emplace_back();
    for (const auto &[column, value] : entries)
      if (!patterns.back().empty() && patterns.back().back() == column)
        values.back() += value;
      else
        {
          patterns.back().push_back(column);
          values.push_back(value);
        }
  }

  SparseMatrix
  RowAssembler::create(const MPI_Comm comm, const unsigned int n_components)
  {
    add_from_others(comm);
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
    patterns = {};
    values   = {};
    return {rows, columns, comm, std::move(result), n_components};
  }
} // namespace mortise
