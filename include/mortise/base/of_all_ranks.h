// Lists of all ranks as one.
#pragma once

#include <deal.II/base/mpi.h>

#include <vector>

namespace mortise
{
  /// @p own of the first rank, of the second one, ... Collective.
  template <typename T>
  std::vector<T>
  of_all_ranks(const std::vector<T> &own, const MPI_Comm comm)
  {
    std::vector<T> all;
    for (const auto &of_rank : dealii::Utilities::MPI::all_gather(comm, own))
      all.insert(all.end(), of_rank.begin(), of_rank.end());
    return all;
  }
} // namespace mortise
