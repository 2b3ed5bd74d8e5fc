// Which multipliers of contact press: lambda >= 0, gap >= 0, lambda gap = 0 by
// the primal-dual active set strategy. It knows no mesh and no matrix.
// Source: Hueber and Wohlmuth (2005), Hueber, Stadler, Wohlmuth (2008).
#pragma once

#include <deal.II/base/mpi.h>
#include <deal.II/base/types.h>

#include <cstdint>
#include <set>
#include <vector>

namespace mortise
{
  class ActiveSet
  {
  public:
    /// @p one_sided: by owned multiplier, may it press only? All start active; the others stay so. @p first: the number
    /// of the first owned one. Collective.
    ActiveSet(std::vector<bool>               one_sided,
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
    /// comes back, from then on only the first of these does, which ends
    /// whatever the gaps' matrix is, as long as its
    /// principal minors are positive. Source: Murty (1974). @p multiplier: by owned one, a pressure; @p gap: a length; @p length: what gaps are
    /// small against; @p accuracy: of both, relative to the largest. Collective.
    Change
    advance(const double *multiplier,
            const double *gap,
            double        length,
            double        accuracy);

    /// Has a set come back since the start?
    bool
    cycles() const
    {
      return one_by_one;
    }

    /// Active ones among those that may press only, of all ranks. Collective.
    std::uint64_t
    n_active() const;

  private:
    std::uint64_t
    fingerprint() const;

    std::vector<bool>               one_sided;
    dealii::types::global_dof_index first;
    MPI_Comm                        comm;
    std::vector<bool>               now;
    std::set<std::uint64_t>         seen; ///< fingerprints
    bool                            one_by_one = false;
  };
} // namespace mortise
