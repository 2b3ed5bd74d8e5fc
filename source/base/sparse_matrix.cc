// See sparse_matrix.h.
#include <deal.II/base/mpi.h>

#include <mortise/base/sort_unique.h>
#include <mortise/base/sparse_matrix.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using Entry = SparseMatrix::Entry;
    using Index = SparseMatrix::Index;

    Index
    first_of(const IndexSet &owned)
    {
      return owned.n_elements() == 0 ? 0 : owned.nth_index_in_set(0);
    }

    /// Who owns which row.
    class Owners
    {
    public:
      /// Collective.
      Owners(const IndexSet &rows, const MPI_Comm comm)
        : ends(Utilities::MPI::all_gather(comm, Index(rows.n_elements())))
      {
        std::partial_sum(ends.begin(), ends.end(), ends.begin());
      }

      unsigned int
      operator()(const Index row) const
      {
        return std::upper_bound(ends.begin(), ends.end(), row) - ends.begin();
      }

    private:
      std::vector<Index> ends; ///< by rank
    };

    /// Those of owned rows, of all ranks. Collective.
    std::vector<Entry>
    of_owned_rows(const IndexSet           &rows,
                  const MPI_Comm            comm,
                  const std::vector<Entry> &entries)
    {
      if (Utilities::MPI::n_mpi_processes(comm) == 1)
        return entries;
      const Owners                               owners(rows, comm);
      std::vector<Entry>                         own;
      std::map<unsigned int, std::vector<Entry>> packages;
      for (const Entry &entry : entries)
        if (rows.is_element(entry.row))
          own.push_back(entry);
        else
          packages[owners(entry.row)].push_back(entry);
      for (const auto &[rank, package] :
           Utilities::MPI::some_to_some(comm, packages))
        own.insert(own.end(), package.begin(), package.end());
      return own;
    }

    SparseMatrix::CompressedRows
    compress(const IndexSet               &rows,
             const std::vector<Entry>     &entries,
             const VectorOperation::values operation)
    {
      const unsigned int       n     = rows.n_elements();
      const Index              first = first_of(rows);
      std::vector<std::size_t> begin(n + 1);
      for (const Entry &entry : entries)
        ++begin[entry.row - first + 1];
      std::partial_sum(begin.begin(), begin.end(), begin.begin());
      std::vector<std::pair<Index, double>> by_row(entries.size());
      auto                                  next = begin;
      for (const Entry &entry : entries)
        by_row[next[entry.row - first]++] = {entry.column, entry.value};
      SparseMatrix::CompressedRows result;
      for (unsigned int i = 0; i < n; ++i)
        {
          const auto from     = by_row.begin() + begin[i],
                     to       = by_row.begin() + begin[i + 1];
          const auto in_order = [](const auto &a, const auto &b) {
            return a.first < b.first;
          };
          if (!std::is_sorted(from, to, in_order))
            std::stable_sort(from, to, in_order);
          for (auto entry = from; entry != to; ++entry)
            if (entry != from && entry->first == result.columns.back())
              result.values.back() +=
                operation == VectorOperation::add ? entry->second : 0.;
            else
              {
                result.columns.push_back(entry->first);
                result.values.push_back(entry->second);
              }
          result.begin.push_back(result.columns.size());
        }
      return result;
    }

    /// Sorts a few ascending runs, one after the other.
    void
    merge_runs(std::vector<unsigned int> &list)
    {
      for (auto end = std::is_sorted_until(list.begin(), list.end());
           end != list.end();)
        {
          const auto next = std::is_sorted_until(end, list.end());
          std::inplace_merge(list.begin(), end, next);
          end = next;
        }
    }
  } // namespace

  IndexSet
  owned_range(const types::global_dof_index n, const MPI_Comm comm)
  {
    const auto  counts = Utilities::MPI::all_gather(comm, n);
    const auto  mine  = counts.begin() + Utilities::MPI::this_mpi_process(comm);
    const Index first = std::accumulate(counts.begin(), mine, Index(0));
    IndexSet    owned(std::accumulate(mine, counts.end(), first));
    owned.add_range(first, first + n);
    owned.compress();
    return owned;
  }

  IndexSet
  by_component(const IndexSet &set, const unsigned int n)
  {
    IndexSet result(n * set.size());
    for (auto range = set.begin_intervals(); range != set.end_intervals();
         ++range)
      result.add_range(n * *range->begin(), n * (range->last() + 1));
    result.compress();
    return result;
  }

  IndexSet
  nodes_of(const IndexSet &set, const unsigned int n)
  {
    IndexSet result(set.size() / n);
    if (const Index size = set.n_elements(); size > 0)
      result.add_range(first_of(set) / n, (first_of(set) + size) / n);
    return result;
  }

  SparseMatrix::SparseMatrix(const IndexSet               &rows,
                             const IndexSet               &columns,
                             const MPI_Comm                comm,
                             const std::vector<Entry>     &entries,
                             const VectorOperation::values operation,
                             const unsigned int            n_components)
    : SparseMatrix(rows,
                   columns,
                   comm,
                   compress(rows,
                            of_owned_rows(rows, comm, entries),
                            operation),
                   n_components)
  {}

  SparseMatrix::SparseMatrix(const IndexSet    &rows,
                             const IndexSet    &columns,
                             const MPI_Comm     comm,
                             CompressedRows     given,
                             const unsigned int n_components)
    : owned_rows(rows)
    , first_row(first_of(rows))
    , n_components(n_components)
    , all(std::move(given))
  {
    number_columns(columns);
    IndexSet used(columns.size());
    used.add_indices(column_indices.begin(), column_indices.end());
    layout = std::make_shared<const Utilities::MPI::Partitioner>(
      by_component(columns, n_components),
      by_component(used, n_components),
      comm);
  }

  void
  SparseMatrix::number_columns(const IndexSet &columns)
  {
    const Index        first = first_of(columns), n = columns.n_elements();
    std::vector<bool>  is_used(n);
    std::vector<Index> others;
    // neighbouring rows mostly have the same columns
    const auto for_each_row = [this](const auto &visit) {
      for (unsigned int i = 0; i < n_rows(); ++i)
        visit(all.columns.begin() + all.begin[i],
              all.columns.begin() + all.begin[i + 1]);
    };
    std::vector<Index> last;
    for_each_row([&](const auto begin, const auto end) {
      if (std::equal(begin, end, last.begin(), last.end()))
        return;
      last.assign(begin, end);
      for (const Index column : last)
        if (column >= first && column < first + n)
          is_used[column - first] = true;
        else
          others.push_back(column);
    });
    sort_unique(others);
    n_below =
      std::lower_bound(others.begin(), others.end(), first) - others.begin();
    column_indices.assign(others.begin(), others.begin() + n_below);
    std::vector<Index> number(n); // of those owned
    for (Index k = 0; k < n; ++k)
      if (is_used[k])
        {
          number[k] = column_indices.size();
          owned.push_back(k);
          column_indices.push_back(first + k);
        }
    column_indices.insert(column_indices.end(),
                          others.begin() + n_below,
                          others.end());
    last.clear();
    std::vector<Index> numbers;
    for_each_row([&](const auto begin, const auto end) {
      if (!std::equal(begin, end, last.begin(), last.end()))
        {
          last.assign(begin, end);
          numbers.clear();
          for (const Index column : last)
            if (column >= first && column < first + n)
              numbers.push_back(number[column - first]);
            else
              {
                const Index other =
                  std::lower_bound(others.begin(), others.end(), column) -
                  others.begin();
                numbers.push_back(other + (other < n_below ? 0 : owned.size()));
              }
        }
      std::copy(numbers.begin(), numbers.end(), begin);
    });
  }

  std::vector<double>
  SparseMatrix::diagonal() const
  {
    std::vector<double> result(n_rows());
    for (unsigned int i = 0; i < n_rows(); ++i)
      for (std::size_t k = all.begin[i]; k < all.begin[i + 1]; ++k)
        if (global_column(all.columns[k]) == global_row(i))
          result[i] = all.values[k];
    return result;
  }

  SparseMatrix::CompressedRows
  SparseMatrix::fetch(const std::vector<Index> &wanted) const
  {
    const Owners owners(owned_rows, communicator());
    const auto   append = [this](CompressedRows &to, const Index global) {
      const Row from = row(global - first_row);
      for (unsigned int k = 0; k < from.length; ++k)
        to.columns.push_back(global_column(from.columns[k]));
      to.values.insert(to.values.end(), from.values, from.values + from.length);
      to.begin.push_back(to.columns.size());
    };
    std::map<unsigned int, std::vector<Index>> asked;
    for (const Index row : wanted)
      if (!owned_rows.is_element(row))
        asked[owners(row)].push_back(row);
    std::map<unsigned int, CompressedRows> answers;
    for (const auto &[rank, rows] :
         Utilities::MPI::some_to_some(communicator(), asked))
      for (const Index row : rows)
        append(answers[rank], row);
    const auto others = Utilities::MPI::some_to_some(communicator(), answers);
    CompressedRows                       result;
    std::map<unsigned int, unsigned int> next; // row of the answer, by rank
    for (const Index row : wanted)
      if (owned_rows.is_element(row))
        append(result, row);
      else
        {
          const unsigned int    rank  = owners(row);
          const CompressedRows &from  = others.at(rank);
          const auto            begin = from.begin[next[rank]],
                     end              = from.begin[++next[rank]];
          result.columns.insert(result.columns.end(),
                                from.columns.begin() + begin,
                                from.columns.begin() + end);
          result.values.insert(result.values.end(),
                               from.values.begin() + begin,
                               from.values.begin() + end);
          result.begin.push_back(result.columns.size());
        }
    return result;
  }

  SparseMatrix
  SparseMatrix::times(const SparseMatrix &B) const
  {
    Assert(n_components == 1 && B.n_components == 1, ExcNotImplemented());
    const CompressedRows of_columns = B.fetch(column_indices);
    const IndexSet       unknowns   = B.owned_unknowns();
    const Index          n = unknowns.n_elements(), first = first_of(unknowns);
    // owned columns, then the others
    std::vector<Index> others;
    for (const Index column : of_columns.columns)
      if (column < first || column >= first + n)
        others.push_back(column);
    sort_unique(others);
    std::vector<unsigned int> places;
    for (const Index column : of_columns.columns)
      places.push_back(
        column >= first && column < first + n ?
          column - first :
          n + (std::lower_bound(others.begin(), others.end(), column) -
               others.begin()));
    std::vector<double>       sums(n + others.size());
    std::vector<char>         is_entry(sums.size());
    std::vector<unsigned int> of_row;
    CompressedRows            result;
    for (unsigned int i = 0; i < n_rows(); ++i)
      {
        const Row own = row(i);
        for (unsigned int k = 0; k < own.length; ++k)
          for (std::size_t e = of_columns.begin[own.columns[k]];
               e < of_columns.begin[own.columns[k] + 1];
               ++e)
            {
              if (!is_entry[places[e]])
                of_row.push_back(places[e]);
              is_entry[places[e]] = true;
              sums[places[e]] += own.values[k] * of_columns.values[e];
            }
        merge_runs(of_row);
        for (const unsigned int place : of_row)
          {
            result.columns.push_back(place < n ? first + place :
                                                 others[place - n]);
            result.values.push_back(sums[place]);
            sums[place]     = 0.;
            is_entry[place] = false;
          }
        result.begin.push_back(result.columns.size());
        of_row.clear();
      }
    return SparseMatrix(owned_rows,
                        B.owned_unknowns(),
                        communicator(),
                        std::move(result));
  }

  SparseMatrix
  SparseMatrix::transposed() const
  {
    std::vector<Entry> entries;
    for (unsigned int i = 0; i < n_rows(); ++i)
      for (std::size_t k = all.begin[i]; k < all.begin[i + 1]; ++k)
        entries.push_back(
          {global_column(all.columns[k]), global_row(i), all.values[k]});
    return SparseMatrix(layout->locally_owned_range(),
                        owned_rows,
                        layout->get_mpi_communicator(),
                        entries);
  }
} // namespace mortise
