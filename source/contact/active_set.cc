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

    /// Sets in turn without fewer violations.
    constexpr unsigned int max_patience = 8;

    /// Less than that of the largest pressure is rounding.
    constexpr double rounding_of_pressures = 1e-13;

    std::uint64_t
    count(const std::vector<bool> &flags, const MPI_Comm comm)
    {
      const std::uint64_t mine = std::count(flags.begin(), flags.end(), true);
      return Utilities::MPI::sum(mine, comm);
    }
  } // namespace

  ActiveSet::ActiveSet(std::vector<bool>             one_sided,
                       std::vector<double>           complementarity,
                       const types::global_dof_index first,
                       const MPI_Comm                comm)
    : one_sided(std::move(one_sided))
    , complementarity(std::move(complementarity))
    , first(first)
    , comm(comm)
    , undecided_multipliers(this->one_sided.size(), false)
  {
    start_from(std::vector<bool>(this->one_sided.size(), true));
  }

  void
  ActiveSet::start_from(const std::vector<bool> &active)
  {
    now = active;
    seen.clear();
    descending = false;
    falling.clear();
    fewest   = std::numeric_limits<std::uint64_t>::max();
    patience = max_patience;
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
          largest[1] = std::max(largest[1], -gap[i] * complementarity[i]);
        }
    Utilities::MPI::max(ArrayView<const double>(largest),
                        comm,
                        ArrayView<double>(largest));
    const double least = accuracy * (largest[0] > 0. ? largest[0] : largest[1]);
    std::vector<bool> turns(now.size(), false);
    for (unsigned int i = 0; i < now.size(); ++i)
      if (one_sided[i])
        {
          const double value    = now[i] ? multiplier[i] : gap[i],
                       rounding = rounding_of_gaps * length,
                       small =
                         now[i] ?
                           std::max(least, rounding * complementarity[i]) :
                           std::max(least / complementarity[i], rounding);
          turns[i]                 = value < -small;
          undecided_multipliers[i] = !turns[i] && value <= small;
        }
    const std::vector<bool> before = now;
    const auto              turn   = [&](const std::vector<bool> &those) {
      for (unsigned int i = 0; i < now.size(); ++i)
        now[i] = before[i] != those[i];
    };
    if (const auto n_wrong = count(turns, comm); !descending && n_wrong > 0)
      {
        std::vector<bool> more = turns;
        if (extend)
          extend(more);
        turn(more);
        if (n_wrong < fewest)
          {
            fewest   = n_wrong;
            patience = max_patience;
          }
        else
          --patience;
        if (patience == 0 || seen.count(fingerprint()) > 0)
          descending = true;
        else
          turns = std::move(more);
      }
    if (descending)
      {
        descend(multiplier, before, rounding_of_pressures * largest[0], turns);
        turn(turns);
      }
    std::uint64_t counts[3] = {0, 0, 0}, sums[3];
    for (unsigned int i = 0; i < now.size(); ++i)
      {
        counts[0] += turns[i] && before[i] ? 1 : 0;
        counts[1] += turns[i] && !before[i] ? 1 : 0;
        counts[2] += undecided_multipliers[i] ? 1 : 0;
      }
    MPI_Allreduce(counts, sums, 3, MPI_UINT64_T, MPI_SUM, comm);
    return {sums[0], sums[1], sums[2]};
  }

  void
  ActiveSet::descend(const double            *multiplier,
                     const std::vector<bool> &before,
                     const double             rounding,
                     std::vector<bool>       &turns)
  {
    std::vector<bool> pulls(turns);
    for (unsigned int i = 0; i < pulls.size(); ++i)
      pulls[i] = pulls[i] && before[i];
    const bool none_pulls = count(pulls, comm) == 0;
    if (!none_pulls)
      turns = pulls;
    double length = 1.;
    if (none_pulls)
      falling.assign(before.size(), 0.);
    else if (falling.size() < before.size())
      length = 0.; // none yet: all tensile ones open
    else
      for (unsigned int i = 0; i < falling.size(); ++i)
        if (pulls[i])
          length = std::min(length, falling[i] / (falling[i] - multiplier[i]));
    length = Utilities::MPI::min(length, comm);
    for (unsigned int i = 0; i < falling.size(); ++i)
      if (one_sided[i] && before[i])
        {
          falling[i] =
            std::max(0., falling[i] + length * (multiplier[i] - falling[i]));
          if (!none_pulls)
            turns[i] = pulls[i] && falling[i] <= rounding;
        }
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
