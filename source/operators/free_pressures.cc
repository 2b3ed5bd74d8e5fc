#include <deal.II/base/mpi.h>

#include <mortise/operators/free_pressures.h>

#include <algorithm>
#include <limits>

namespace mortise
{
  using namespace dealii;

  void
  FreePressures::add(const Vector &one, const Vector &mass)
  {
    groups.push_back({one, mass, one * mass, -1});
    const auto begin = one.begin(), end = begin + one.locally_owned_size(),
               first    = std::find(begin, end, 1.);
    const MPI_Comm comm = one.get_mpi_communicator();
    const int      me   = Utilities::MPI::this_mpi_process(comm);
    if (Utilities::MPI::min(first == end ? std::numeric_limits<int>::max() : me,
                            comm) == me)
      groups.back().pinned = first - begin;
  }
} // namespace mortise
