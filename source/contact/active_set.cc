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

    /// Of the numbers of all ranks, @p n of this one.
    types::global_dof_index
    first_of_rank(const unsigned int n, const MPI_Comm comm)
    {
      const std::uint64_t own   = n;
      std::uint64_t       up_to = 0;
      MPI_Scan(&own, &up_to, 1, MPI_UINT64_T, MPI_SUM, comm);
      return up_to - n;
    }

    std::uint64_t
    count(const std::vector<bool> &flags, const MPI_Comm comm)
    {
      const std::uint64_t mine = std::count(flags.begin(), flags.end(), true);
      return Utilities::MPI::sum(mine, comm);
    }
  } // namespace

  ActiveSet::ActiveSet(std::vector<double> complementarity,
                       const bool          has_energy,
                       const MPI_Comm      comm)
    : complementarity(std::move(complementarity))
    , has_energy(has_energy)
    , comm(comm)
    , first(first_of_rank(this->complementarity.size(), comm))
    , undecided_nodes(this->complementarity.size(), false)
  {
    start_from(std::vector<bool>(this->complementarity.size(), true));
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
  ActiveSet::advance(const std::vector<double>                      &pressure,
                     const std::vector<double>                      &gap,
                     const double                                    length,
                     const double                                    accuracy,
                     const std::function<void(std::vector<bool> &)> &extend)
  {
    seen.insert(fingerprint());
    // of pressures, of those that overlaps stand for, of gaps
    double largest[3] = {0., 0., 0.};
    for (unsigned int i = 0; i < now.size(); ++i)
      {
        largest[0] = std::max(largest[0], std::fabs(pressure[i]));
        largest[1] = std::max(largest[1], -gap[i] * complementarity[i]);
        largest[2] = std::max(largest[2], std::fabs(gap[i]));
      }
    Utilities::MPI::max(ArrayView<const double>(largest),
                        comm,
                        ArrayView<double>(largest));
    const double least = accuracy * (largest[0] > 0. ? largest[0] : largest[1]);
    std::vector<bool> turns(now.size(), false);
    for (unsigned int i = 0; i < now.size(); ++i)
      {
        const double value    = now[i] ? pressure[i] : gap[i],
                     rounding = rounding_of_gaps * std::max(length, largest[2]),
                     small    = now[i] ?
                                  std::max(least, rounding * complementarity[i]) :
                                  std::max(least / complementarity[i], rounding);
        turns[i]              = value < -small;
        undecided_nodes[i]    = !turns[i] && value <= small;
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
        else if (patience > 0)
          --patience;
        const bool is_stuck =
          patience == 0 || (has_energy && seen.count(fingerprint()) > 0);
        descending = is_stuck && has_energy;
        if (!is_stuck)
          turns = std::move(more);
        else if (!has_energy)
          {
            keep_worst(pressure, gap, turns);
            turn(turns);
          }
      }
    if (descending)
      {
        descend(pressure, before, rounding_of_pressures * largest[0], turns);
        turn(turns);
      }
    std::uint64_t counts[3] = {0, 0, 0}, sums[3];
    for (unsigned int i = 0; i < now.size(); ++i)
      {
        counts[0] += turns[i] && before[i] ? 1 : 0;
        counts[1] += turns[i] && !before[i] ? 1 : 0;
        counts[2] += undecided_nodes[i] ? 1 : 0;
      }
    MPI_Allreduce(counts, sums, 3, MPI_UINT64_T, MPI_SUM, comm);
    return {sums[0], sums[1], sums[2]};
  }

  void
  ActiveSet::keep_worst(const std::vector<double> &pressure,
                        const std::vector<double> &gap,
                        std::vector<bool>         &turns) const
  {
    const auto violation = [&](const unsigned int i) {
      return std::max(-pressure[i], -complementarity[i] * gap[i]);
    };
    double largest = 0.;
    for (unsigned int i = 0; i < turns.size(); ++i)
      if (turns[i])
        largest = std::max(largest, violation(i));
    largest = Utilities::MPI::max(largest, comm);
    for (unsigned int i = 0; i < turns.size(); ++i)
      turns[i] = turns[i] && violation(i) >= 0.5 * largest;
  }

  void
  ActiveSet::descend(const std::vector<double> &pressure,
                     const std::vector<bool>   &before,
                     const double               rounding,
                     std::vector<bool>         &turns)
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
          length = std::min(length, falling[i] / (falling[i] - pressure[i]));
    length = Utilities::MPI::min(length, comm);
    for (unsigned int i = 0; i < falling.size(); ++i)
      if (before[i])
        {
          falling[i] =
            std::max(0., falling[i] + length * (pressure[i] - falling[i]));
          if (!none_pulls)
            turns[i] = pulls[i] && falling[i] <= rounding;
        }
  }

  std::uint64_t
  ActiveSet::n_active() const
  {
    return count(now, comm);
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
