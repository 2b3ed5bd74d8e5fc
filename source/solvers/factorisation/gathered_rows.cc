// See gathered_rows.h.
#include <deal.II/base/mpi.h>

#include <mortise/solvers/factorisation/gathered_rows.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    template <typename T>
    std::vector<T>
    gather_on_all(const std::vector<T> &mine, const MPI_Comm comm)
    {
      int n_ranks = 1, n_mine = mine.size();
      MPI_Comm_size(comm, &n_ranks);
      std::vector<int> counts(n_ranks), starts(n_ranks + 1);
      MPI_Allgather(&n_mine, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
      std::partial_sum(counts.begin(), counts.end(), starts.begin() + 1);
      std::vector<T> all(starts.back());
      const auto     type = Utilities::MPI::mpi_type_id_for_type<T>;
      MPI_Allgatherv(mine.data(),
                     n_mine,
                     type,
                     all.data(),
                     counts.data(),
                     starts.data(),
                     type,
                     comm);
      return all;
    }
  } // namespace

  GatheredRows::GatheredRows(const RowsByNode &rows, const MPI_Comm comm)
    : n_components(rows.n_components)
  {
    const bool alone = Utilities::MPI::n_mpi_processes(comm) == 1;
    if (!alone)
      {
        gathered.lengths  = gather_on_all(rows.lengths, comm);
        gathered.columns  = gather_on_all(rows.columns, comm);
        gathered.variants = gather_on_all(rows.variants, comm);
        gathered.values   = gather_on_all(rows.values, comm);
      }
    const RowsByNode &all     = alone ? rows : gathered;
    const auto       &lengths = all.lengths;
    columns                   = make_array_view(all.columns);
    variants                  = make_array_view(all.variants);
    values                    = make_array_view(all.values);
    begin.assign(lengths.size() + 1, 0);
    std::partial_sum(lengths.begin(), lengths.end(), begin.begin() + 1);
    std::size_t n_values = 0;
    scale.assign(lengths.size(), 0.);
    for (unsigned int i = 0; i < size(); ++i)
      {
        begin_values.push_back(n_values);
        n_values += std::size_t(variants[i]) * lengths[i];
        for (unsigned int k = begin[i]; k < begin[i + 1]; ++k)
          if (columns[k] == static_cast<int>(i))
            {
              double least = row(i, 0)[k - begin[i]], largest = least;
              for (unsigned int c = 1; c < n_components; ++c)
                {
                  least   = std::min(least, row(i, c)[k - begin[i]]);
                  largest = std::max(largest, row(i, c)[k - begin[i]]);
                }
              if (least > 0.)
                scale[i] = 1. / std::sqrt(largest);
            }
      }
  }
} // namespace mortise
