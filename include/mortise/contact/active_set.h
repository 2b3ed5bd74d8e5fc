// Which multipliers of contact press: lambda >= 0, gap >= 0, lambda gap = 0 by
// the primal-dual active set strategy. It knows no mesh and no matrix.
// Source: Hueber and Wohlmuth (2005), Hueber, Stadler, Wohlmuth (2008).
#pragma once

#include <deal.II/base/mpi.h>
#include <deal.II/base/types.h>

#include <cstdint>
#include <functional>
#include <set>
#include <vector>

namespace mortise
{
  class ActiveSet
  {
  public:
    /// By owned multiplier: @p one_sided, may it press only? All start active; the others stay so.
    /// @p stiffness: what makes a pressure of a gap. @p first: the number of the first owned one. Collective.
    ActiveSet(std::vector<bool>               one_sided,
              std::vector<double>             stiffness,
              dealii::types::global_dof_index first,
              MPI_Comm                        comm);

    /// By owned multiplier.
    const std::vector<bool> &
    active() const
    {
      return now;
    }

    /// Start from these, by owned multiplier, as if no other set had been.
    void
    start_from(const std::vector<bool> &active);

    struct Change
    {
      std::uint64_t opened = 0, closed = 0;
      /// Pressure and gap are zero but for rounding: they stay what they are.
      std::uint64_t undecided = 0;

      bool
      any() const
      {
        return opened + closed > 0;
      }
    };

    /// Go to the next set from what solves the equations of this one: active
    /// multipliers that pull open, gaps that are negative close. When a set
    /// comes back, or eight in turn have no fewer violations than one before,
    /// the energy decides from then on: see descend().
    ///
    /// @p multiplier: by owned one, a pressure; @p gap: a length; @p length: what rounding of gaps is
    /// relative to; @p accuracy: of both, relative to the largest pressure. @p extend: may add to those
    /// that turn; not asked where one does. Collective.
    Change
    advance(const double                                        *multiplier,
            const double                                        *gap,
            double                                               length,
            double                                               accuracy,
            const std::function<void(std::vector<bool> &turns)> &extend = {});

    /// By owned multiplier: was it among Change::undecided the last time?
    const std::vector<bool> &
    undecided() const
    {
      return unclear;
    }

    /// Have sets come back since the start?
    bool
    cycles() const
    {
      return descending;
    }

    /// Active ones among those that may press only, of all ranks. Collective.
    std::uint64_t
    n_active() const;

  private:
    std::uint64_t
    fingerprint() const;
    /// Keeps pressures that press everywhere and whose complementary energy
    /// falls from set to set, so that none comes back. They are those of a set
    /// where nothing pulls; then all gaps that overlap close. Where a set
    /// pulls, they go towards its pressures until the first is zero, and what
    /// pulls and is zero opens. Source: Lawson and Hanson (1974), several at a
    /// time as
    /// far as it goes. @p before: the set of these multipliers; @p rounding: of pressures;
    /// @p turns: those that violate, then those to turn. Collective.
    void
    descend(const double            *multiplier,
            const std::vector<bool> &before,
            double                   rounding,
            std::vector<bool>       &turns);

    std::vector<bool>               one_sided;
    std::vector<double>             stiffness;
    dealii::types::global_dof_index first;
    MPI_Comm                        comm;
    std::vector<bool>               now, unclear;
    std::set<std::uint64_t>         seen;     ///< fingerprints
    std::uint64_t                   fewest;   ///< violations since the start
    unsigned int                    patience; ///< sets until there are fewer
    bool                            descending;
    std::vector<double> falling; ///< see descend(); empty at its beginning
  };
} // namespace mortise
