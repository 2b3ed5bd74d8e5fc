// See coupling_transpose.h.
#include <deal.II/base/mpi.h>

#include <mortise/solvers/multipliers/coupling_transpose.h>

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

  } // namespace

  CouplingTranspose::CouplingTranspose(const CouplingRows        &B,
                                       const LevelVector<double> &weights)
    : begin(B.displacements.size() + 1)
  {
    collect_own(B, weights);
    const SparseMatrix &rows = B.matrix.scalar();
    if (Utilities::MPI::n_mpi_processes(rows.communicator()) > 1)
      replace(B, exchange(B, weights));
    make_local(rows);
  }

  void
  CouplingTranspose::collect_own(const CouplingRows        &B,
                                 const LevelVector<double> &weights)
  {
    const auto for_each_entry = [&B](const auto &visit) {
      for (const auto &of_entity : B.rows)
        for (const SharedRows &shared : of_entity)
          for (unsigned int c = 0; c < dim; ++c)
            for (int i = 0; i < shared.n_rows && shared.first_row[c] >= 0; ++i)
              {
                const auto row = static_cast<int>(
                  B.matrix.scalar().global_row(shared.first_row[c] + i));
                const double *from =
                  shared.values.data() + i * shared.nodes.size();
                for (unsigned int k = 0; k < shared.nodes.size(); ++k)
                  if (const auto v = dim * shared.nodes[k] + c;
                      B.displacements[v] >= 0)
                    visit(v, Entry(row, from[k]));
              }
    };
    for_each_entry([this](const auto v, const Entry &) { ++begin[v + 1]; });
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    entries.resize(begin.back());
    std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
    for_each_entry(
      [&](const auto v, const Entry &entry) { entries[next[v]++] = entry; });
    const auto &owned = *weights.get_partitioner();
    for (std::size_t v = 0; v + 1 < begin.size(); ++v)
      if (const int displacement = B.displacements[v];
          displacement >= 0 && owned.in_local_range(displacement))
        for (std::size_t k = begin[v]; k < begin[v + 1]; ++k)
          entries[k].second *= weights(displacement);
  }

  CouplingTranspose::Rows
  CouplingTranspose::exchange(const CouplingRows        &B,
                              const LevelVector<double> &weights) const
  {
    const auto      &owned = *weights.get_partitioner();
    const MPI_Comm   comm  = owned.get_mpi_communicator();
    std::vector<int> ends =
      Utilities::MPI::all_gather(comm,
                                 static_cast<int>(owned.locally_owned_size()));
    std::partial_sum(ends.begin(), ends.end(), ends.begin());
    SentEntries to_owners;
    for (std::size_t v = 0; v + 1 < begin.size(); ++v)
      if (const int displacement = B.displacements[v];
          displacement >= 0 && !owned.in_local_range(displacement))
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
          rows[entry.displacement].emplace_back(entry.multiplier,
                                                entry.value *
                                                  weights(entry.displacement));
          asked[rank].insert(entry.displacement);
        }
    for (std::size_t v = 0; v + 1 < begin.size(); ++v)
      if (const auto row = rows.find(B.displacements[v]); row != rows.end())
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
        if (const auto row = rows.find(B.displacements[v]); row != rows.end())
          entries.insert(entries.end(), row->second.begin(), row->second.end());
        else
          entries.insert(entries.end(),
                         own_entries.begin() + own_begin[v],
                         own_entries.begin() + own_begin[v + 1]);
        begin[v + 1] = entries.size();
      }
  }

  void
  CouplingTranspose::make_local(const SparseMatrix &rows)
  {
    std::vector<int> others;
    for (const auto &[multiplier, value] : entries)
      if (!rows.rows().is_element(multiplier))
        others.push_back(multiplier);
    std::sort(others.begin(), others.end());
    IndexSet ghosts(rows.m());
    ghosts.add_indices(others.begin(),
                       std::unique(others.begin(), others.end()));
    multipliers =
      std::make_shared<const Utilities::MPI::Partitioner>(rows.rows(),
                                                          ghosts,
                                                          rows.communicator());
    for (auto &[multiplier, value] : entries)
      multiplier = static_cast<int>(multipliers->global_to_local(multiplier));
  }
} // namespace mortise
