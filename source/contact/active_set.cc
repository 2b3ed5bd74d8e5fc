// See active_set.h.
#include <mortise/contact/active_set.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace mortise
{
  using namespace dealii;

  ActiveSet::ActiveSet(std::vector<bool>             one_sided,
                       const types::global_dof_index first,
                       const MPI_Comm                comm)
    : one_sided(std::move(one_sided))
    , first(first)
    , comm(comm)
    , now(this->one_sided.size(), true)
  {}

  void
  ActiveSet::start_from(const std::vector<bool> &active)
  {
    now = active;
    seen.clear();
    one_by_one = false;
  }

  ActiveSet::Change
  ActiveSet::advance(const double *multiplier,
                     const double *gap,
                     const double  length,
                     const double  accuracy)
  {
    seen.insert(fingerprint());
    double largest = 0.;
    for (unsigned int i = 0; i < now.size(); ++i)
      if (one_sided[i])
        largest = std::max(largest, std::fabs(multiplier[i]));
    const double least_pressure =
                   -accuracy * Utilities::MPI::max(largest, comm),
                 least_gap = -accuracy * length;
    std::vector<unsigned int> wrong;
    Change                    change;
    for (unsigned int i = 0; i < now.size(); ++i)
      if (one_sided[i])
        {
          if (now[i] ? multiplier[i] < least_pressure : gap[i] < least_gap)
            wrong.push_back(i);
          else if (now[i] ? multiplier[i] <= -least_pressure :
                            gap[i] <= -least_gap)
            ++change.undecided;
        }
    const auto none = std::numeric_limits<types::global_dof_index>::max();
    const auto least =
      Utilities::MPI::min(wrong.empty() ? none : first + wrong.front(), comm);
    const auto turn = [&](const bool only_least) {
      for (const unsigned int i : wrong)
        if (!only_least || first + i == least)
          now[i] = !now[i];
    };
    turn(one_by_one);
    if (!one_by_one && seen.count(fingerprint()) > 0 && least != none)
      {
        turn(false); // back
        one_by_one = true;
        turn(true);
      }
    for (const unsigned int i : wrong)
      if (!one_by_one || first + i == least)
        ++(now[i] ? change.closed : change.opened);
    std::uint64_t counts[] = {change.opened, change.closed, change.undecided};
    std::uint64_t sums[3];
    MPI_Allreduce(counts, sums, 3, MPI_UINT64_T, MPI_SUM, comm);
    return {sums[0], sums[1], sums[2]};
  }

  std::uint64_t
  ActiveSet::n_active() const
  {
    std::uint64_t n = 0;
    for (unsigned int i = 0; i < now.size(); ++i)
      n += one_sided[i] && now[i] ? 1 : 0;
    return Utilities::MPI::sum(n, comm);
  }

  std::uint64_t
  ActiveSet::fingerprint() const
  {
    std::uint64_t sum = 0;
    for (unsigned int i = 0; i < now.size(); ++i)
      if (now[i])
        {
          // the last step of splitmix64: neighbours become unlike
          std::uint64_t z = first + i + 0x9e3779b97f4a7c15U;
          z               = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
          z               = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
          sum += z ^ (z >> 31);
        }
    std::uint64_t of_all = 0;
    MPI_Allreduce(&sum, &of_all, 1, MPI_UINT64_T, MPI_SUM, comm);
    return of_all;
  }
} // namespace mortise
