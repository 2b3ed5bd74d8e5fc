// See active_set.h.
#include <deal.II/base/array_view.h>

#include <mortise/contact/active_set.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Less than that of a length is rounding.
    constexpr double rounding_of_gaps = 1e-13;
  } // namespace

  ActiveSet::ActiveSet(std::vector<bool>             one_sided,
                       std::vector<double>           stiffness,
                       const types::global_dof_index first,
                       const MPI_Comm                comm)
    : one_sided(std::move(one_sided))
    , stiffness(std::move(stiffness))
    , first(first)
    , comm(comm)
    , now(this->one_sided.size(), true)
    , unclear(this->one_sided.size(), false)
  {}

  void
  ActiveSet::start_from(const std::vector<bool> &active)
  {
    now = active;
    seen.clear();
    one_by_one = false;
  }

  ActiveSet::Change
  ActiveSet::advance(const double                                   *multiplier,
                     const double                                   *gap,
                     const double                                    length,
                     const double                                    accuracy,
                     const std::function<void(std::vector<bool> &)> &extend)
  {
    seen.insert(fingerprint());
    double largest[2] = {0., 0.}; // of pressures, of gaps that overlap
    for (unsigned int i = 0; i < now.size(); ++i)
      if (one_sided[i])
        {
          largest[0] = std::max(largest[0], std::fabs(multiplier[i]));
          largest[1] = std::max(largest[1], -gap[i] * stiffness[i]);
        }
    Utilities::MPI::max(ArrayView<const double>(largest),
                        comm,
                        ArrayView<double>(largest));
    const double least = accuracy * (largest[0] > 0. ? largest[0] : largest[1]);
    std::vector<bool> turns(now.size(), false);
    for (unsigned int i = 0; i < now.size(); ++i)
      if (one_sided[i])
        {
          const double value = now[i] ? multiplier[i] : gap[i],
                       small = now[i] ? least :
                                        std::max(least / stiffness[i],
                                                 rounding_of_gaps * length);
          turns[i]           = value < -small;
          unclear[i]         = !turns[i] && value <= small;
        }
    const auto none = std::numeric_limits<types::global_dof_index>::max();
    const auto mine = std::find(turns.begin(), turns.end(), true);
    const auto least_wrong = Utilities::MPI::min(
      mine == turns.end() ? none : first + (mine - turns.begin()), comm);
    const std::vector<bool> before = now;
    const auto              turn   = [&] {
      for (unsigned int i = 0; i < now.size(); ++i)
        now[i] = before[i] != turns[i];
    };
    if (!one_by_one && least_wrong != none)
      {
        if (extend)
          extend(turns);
        turn();
        if (seen.count(fingerprint()) > 0)
          one_by_one = true;
      }
    if (one_by_one)
      {
        for (unsigned int i = 0; i < now.size(); ++i)
          turns[i] = first + i == least_wrong;
        turn();
      }
    std::uint64_t counts[3] = {0, 0, 0}, sums[3];
    for (unsigned int i = 0; i < now.size(); ++i)
      {
        counts[0] += turns[i] && before[i] ? 1 : 0;
        counts[1] += turns[i] && !before[i] ? 1 : 0;
        counts[2] += unclear[i] ? 1 : 0;
      }
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
