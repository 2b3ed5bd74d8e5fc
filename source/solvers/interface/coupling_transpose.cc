// See coupling_transpose.h.
#include <deal.II/base/mpi.h>

#include <mortise/solvers/epetra_tools.h>
#include <mortise/solvers/interface/coupling_transpose.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// An entry of a row that ranks send to each other.
    struct SentEntry
    {
      int    displacement = 0, multiplier = 0;
      double value = 0.;

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &displacement &multiplier &value;
      }
    };

    using SentEntries = std::map<unsigned int, std::vector<SentEntry>>;

    /// The displacement of each value that multipliers move; -1: none.
    int
    displacement_of(const CouplingRows &B, const std::size_t v)
    {
      const int column = B.moved.column_of_value[v];
      return column < 0 ? -1 : B.matrix.GCID(column);
    }
  } // namespace

  CouplingTranspose::CouplingTranspose(const CouplingRows        &B,
                                       const LevelVector<double> &weights)
    : multipliers(B.matrix.RowMap())
    , begin(B.moved.column_of_value.size() + 1)
  {
    collect_own(B, weights);
    if (multipliers.Comm().NumProc() > 1)
      {
        replace(B, exchange(B, weights));
        make_map();
      }
  }

  void
  CouplingTranspose::collect_own(const CouplingRows        &B,
                                 const LevelVector<double> &weights)
  {
    const auto for_each_entry = [&B](const auto &visit) {
      for (int i = 0; i < B.matrix.NumMyRows(); ++i)
        {
          const EpetraRow row(B.matrix, i);
          const int       multiplier = B.matrix.GRID(i);
          for (int k = 0; k < row.length; ++k)
            visit(B.moved.value_of_column[row.columns[k]],
                  Entry(multiplier, row.values[k]));
        }
    };
    for_each_entry([this](const int v, const Entry &) { ++begin[v + 1]; });
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    entries.resize(begin.back());
    std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
    for_each_entry(
      [&](const int v, const Entry &entry) { entries[next[v]++] = entry; });
    const Epetra_Map &owned = B.matrix.DomainMap();
    for (std::size_t v = 0; v + 1 < begin.size(); ++v)
      if (const int displacement = displacement_of(B, v);
          displacement >= 0 && owned.MyGID(displacement))
        for (std::size_t k = begin[v]; k < begin[v + 1]; ++k)
          entries[k].second *= weights.local_element(owned.LID(displacement));
  }

  CouplingTranspose::Rows
  CouplingTranspose::exchange(const CouplingRows        &B,
                              const LevelVector<double> &weights) const
  {
    const Epetra_Map &owned = B.matrix.DomainMap();
    const MPI_Comm    comm  = communicator(owned);
    std::vector<int>  ends =
      Utilities::MPI::all_gather(comm, owned.NumMyElements());
    std::partial_sum(ends.begin(), ends.end(), ends.begin());
    SentEntries to_owners;
    for (std::size_t v = 0; v + 1 < begin.size(); ++v)
      if (const int displacement = displacement_of(B, v);
          displacement >= 0 && !owned.MyGID(displacement))
        {
          auto &list =
            to_owners[std::upper_bound(ends.begin(), ends.end(), displacement) -
                      ends.begin()];
          for (std::size_t k = begin[v]; k < begin[v + 1]; ++k)
            list.push_back({displacement, entries[k].first, entries[k].second});
        }

    Rows                                  rows;
    std::map<unsigned int, std::set<int>> asked;
    for (const auto &[rank, list] :
         Utilities::MPI::some_to_some(comm, to_owners))
      for (const SentEntry &entry : list)
        {
          rows[entry.displacement].emplace_back(
            entry.multiplier,
            entry.value * weights.local_element(owned.LID(entry.displacement)));
          asked[rank].insert(entry.displacement);
        }
    for (std::size_t v = 0; v + 1 < begin.size(); ++v)
      if (const auto row = rows.find(displacement_of(B, v)); row != rows.end())
        row->second.insert(row->second.end(),
                           entries.begin() + begin[v],
                           entries.begin() + begin[v + 1]);
    SentEntries answers;
    for (const auto &[rank, displacements] : asked)
      for (const int displacement : displacements)
        for (const auto &[multiplier, value] : rows[displacement])
          answers[rank].push_back({displacement, multiplier, value});
    for (const auto &[rank, list] : Utilities::MPI::some_to_some(comm, answers))
      for (const SentEntry &entry : list)
        rows[entry.displacement].emplace_back(entry.multiplier, entry.value);
    return rows;
  }

  void
  CouplingTranspose::replace(const CouplingRows &B, const Rows &rows)
  {
    std::vector<std::size_t> own_begin(begin.size());
    std::vector<Entry>       own_entries;
    own_begin.swap(begin);
    own_entries.swap(entries);
    std::size_t n_entries = own_entries.size();
    for (const auto &[displacement, row] : rows)
      n_entries += row.size();
    entries.reserve(n_entries);
    for (std::size_t v = 0; v + 1 < begin.size(); ++v)
      {
        if (const auto row = rows.find(displacement_of(B, v));
            row != rows.end())
          entries.insert(entries.end(), row->second.begin(), row->second.end());
        else
          entries.insert(entries.end(),
                         own_entries.begin() + own_begin[v],
                         own_entries.begin() + own_begin[v + 1]);
        begin[v + 1] = entries.size();
      }
  }

  void
  CouplingTranspose::make_map()
  {
    const Epetra_Map owned(multipliers);
    const int  n = owned.NumMyElements(), first = n > 0 ? owned.GID(0) : 0;
    const auto is_owned = [&](const int multiplier) {
      return multiplier >= first && multiplier < first + n;
    };
    std::vector<int> list(n), ghosts;
    std::iota(list.begin(), list.end(), first);
    for (const auto &[multiplier, value] : entries)
      if (!is_owned(multiplier))
        ghosts.push_back(multiplier);
    std::sort(ghosts.begin(), ghosts.end());
    ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
    list.insert(list.end(), ghosts.begin(), ghosts.end());
    multipliers = Epetra_Map(-1, list.size(), list.data(), 0, owned.Comm());
    for (auto &[multiplier, value] : entries)
      multiplier =
        is_owned(multiplier) ?
          multiplier - first :
          n + (std::lower_bound(ghosts.begin(), ghosts.end(), multiplier) -
               ghosts.begin());
  }
} // namespace mortise
