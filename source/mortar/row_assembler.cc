// See row_assembler.h.
#include <deal.II/base/mpi.h>

#include <Epetra_CrsGraph.h>
#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>
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
      sets.back().push_back(key(column.index[e]));
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
    const unsigned int  n_rows    = transposed ? block.n() : block.m();
    const unsigned int  n_columns = transposed ? block.m() : block.n();
    const unsigned int *at        = &column.begin[column.offset];
    const unsigned int  first     = at[0];
    std::vector<Index>  keys;
    for (unsigned int e = first; e < at[n_columns]; ++e)
      keys.push_back(key(column.index[e]));
    std::vector<double>              sums(keys.size());
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
                places  = &find_places(keys, patterns[pattern], n_patterns++);
              }
            const double scale = factor * row.weight[e];
            double      *to    = values.data() + begin[r];
            for (unsigned int k = 0; k < sums.size(); ++k)
              to[(*places)[k]] += scale * sums[k];
          }
      }
  }

  const std::vector<unsigned int> &
  RowAssembler::find_places(const std::vector<Index> &keys,
                            const std::vector<Index> &pattern,
                            const unsigned int        guess)
  {
    if (guess == guesses.size())
      guesses.emplace_back();
    auto &places = guesses[guess];
    places.resize(keys.size());
    for (unsigned int k = 0; k < keys.size(); ++k)
      if (places[k] >= pattern.size() || pattern[places[k]] != keys[k])
        places[k] = std::lower_bound(pattern.begin(), pattern.end(), keys[k]) -
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
        for (const Index place : list)
          indices.push_back(column_of(place));
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
              to.emplace_back(key(*index++), *value++);
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
    for (const auto &[key, value] : entries)
      if (!patterns.back().empty() && patterns.back().back() == key)
        values.back() += value;
      else
        {
          patterns.back().push_back(key);
          values.push_back(value);
        }
  }

  std::vector<RowAssembler::Index>
  RowAssembler::used_keys() const
  {
    std::vector<char>  is_seen(patterns.size());
    std::vector<bool>  is_used(columns.n_elements());
    std::vector<Index> keys, others;
    for (const int r : number_of_owned)
      if (r >= 0 && !is_seen[pattern_of[r]])
        {
          is_seen[pattern_of[r]] = true;
          for (const Index key : patterns[pattern_of[r]])
            if (key < columns.size())
              is_used[columns.index_within_set(key)] = true;
            else
              others.push_back(key);
        }
    make_unique(others);
    // a rank alone needs no import where it has all
    const bool all = columns.n_elements() == columns.size();
    for (const Index column : columns)
      if (all || is_used[columns.index_within_set(column)])
        keys.push_back(column);
    keys.insert(keys.end(), others.begin(), others.end());
    return keys;
  }

  void
  RowAssembler::create(SparseMatrix &matrix, const MPI_Comm comm)
  {
    add_from_others(comm);
    const std::vector<Index> keys = used_keys();
    std::vector<int>         used, place_of_owned(columns.n_elements());
    for (const Index key : keys)
      {
        if (key < columns.size())
          place_of_owned[columns.index_within_set(key)] =
            static_cast<int>(used.size());
        used.push_back(static_cast<int>(column_of(key)));
      }
    const Epetra_Map row_map(rows.make_trilinos_map(comm, false)),
      domain_map(columns.make_trilinos_map(comm, false)),
      column_map(
        -1, static_cast<int>(used.size()), used.data(), 0, row_map.Comm());

    const int        n_owned = static_cast<int>(number_of_owned.size());
    std::vector<int> lengths(n_owned);
    for (int i = 0; i < n_owned; ++i)
      if (const int r = number_of_owned[i]; r >= 0)
        lengths[i] = static_cast<int>(patterns[pattern_of[r]].size());
    Epetra_CrsGraph  graph(Copy, row_map, column_map, lengths.data(), true);
    std::vector<int> places; // of the columns of a row
    int              pattern = -1;
    for (int i = 0; i < n_owned; ++i)
      if (const int r = number_of_owned[i]; r >= 0 && lengths[i] > 0)
        {
          if (static_cast<int>(pattern_of[r]) != pattern)
            {
              pattern = static_cast<int>(pattern_of[r]);
              places.clear();
              for (const Index key : patterns[pattern])
                places.push_back(
                  key < columns.size() ?
                    place_of_owned[columns.index_within_set(key)] :
                    std::lower_bound(keys.begin(), keys.end(), key) -
                      keys.begin());
            }
          graph.InsertMyIndices(i, lengths[i], places.data());
        }
    graph.FillComplete(domain_map, row_map);
    matrix.reinit(Epetra_CrsMatrix(View, graph), false);
    for (int i = 0; i < n_owned; ++i)
      if (const int r = number_of_owned[i]; r >= 0)
        {
          int     n       = 0;
          int    *indices = nullptr;
          double *to      = nullptr;
          matrix.trilinos_matrix().ExtractMyRowView(i, n, to, indices);
          std::copy_n(values.begin() + begin[r], n, to);
        }
  }
} // namespace mortise
