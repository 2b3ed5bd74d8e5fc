// Primal-dual active set strategy for the contact conditions lambda >= 0, g
// >= 0, lambda g = 0. Source: Hueber and Wohlmuth (2005), Hueber, Stadler,
// Wohlmuth (2008).
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
    /// All nodes of contact start active. @p complementarity: by owned node, the
    /// complementarity parameter c in lambda - c g, force per volume.
    /// @p has_energy: does the solution with a set minimise one, as without
    /// friction? Collective.
    ActiveSet(std::vector<double> complementarity,
              bool                has_energy,
              MPI_Comm            comm);

    /// By owned node.
    const std::vector<bool> &
    active() const
    {
      return now;
    }

    /// Restart from this set, by owned node, and forget earlier ones.
    void
    start_from(const std::vector<bool> &active);

    struct Change
    {
      std::uint64_t opened = 0, closed = 0;
      /// Nodes whose pressure and gap are zero to rounding; they keep their
      /// state.
      std::uint64_t undecided = 0;

      bool
      any() const
      {
        return opened + closed > 0;
      }
    };

    /// Compute the next set from the solution with this one: active nodes with
    /// lambda < 0 open, inactive ones with g < 0 close. Once a set recurs, or
    /// eight sets in a row do not reduce the number of violated conditions,
    /// descend() chooses the sets; without an energy only the conditions that
    /// are violated most are changed until they are fewer.
    ///
    /// By owned node: @p pressure, and @p gap, a length. @p length: scale of the
    /// rounding of gaps, where that is more than the largest gap. @p accuracy: of
    /// both, relative to the largest pressure.
    /// @p extend: may add nodes to those that change; called only if some
    /// change. Collective.
    Change
    advance(const std::vector<double>                           &pressure,
            const std::vector<double>                           &gap,
            double                                               length,
            double                                               accuracy,
            const std::function<void(std::vector<bool> &turns)> &extend = {});

    /// By owned node: did the last advance() count it as undecided?
    const std::vector<bool> &
    undecided() const
    {
      return undecided_nodes;
    }

    /// Has a set recurred since the start?
    bool
    cycles() const
    {
      return descending;
    }

    /// Number of active nodes on all ranks. Collective.
    std::uint64_t
    n_active() const;

  private:
    std::uint64_t
    fingerprint() const;
    /// Active set method that terminates: it keeps feasible pressures (lambda
    /// >= 0) whose complementary energy falls from set to set. If a set has no
    /// negative pressure, its pressures are kept and all negative gaps close;
    /// otherwise the kept pressures move towards those of the set until the
    /// first is zero, and negative ones that are zero open. Source: Lawson and
    /// Hanson (1974), with several nodes at a time. @p before: the set that
    /// @p pressure solves; @p rounding: of pressures; @p turns: the violated
    /// conditions, on return the nodes that change. Collective.
    void
    descend(const std::vector<double> &pressure,
            const std::vector<bool>   &before,
            double                     rounding,
            std::vector<bool>         &turns);

    /// Of @p turns, those whose pressure, or that of their gap, is at least half
    /// of the largest. Collective.
    void
    keep_worst(const std::vector<double> &pressure,
               const std::vector<double> &gap,
               std::vector<bool>         &turns) const;

    std::vector<double>             complementarity;
    bool                            has_energy;
    MPI_Comm                        comm;
    dealii::types::global_dof_index first; ///< number of the first owned node
    std::vector<bool>               now, undecided_nodes;
    std::set<std::uint64_t>         seen; ///< fingerprints
    std::uint64_t       fewest;   ///< violated conditions since the start
    unsigned int        patience; ///< sets until there are fewer
    bool                descending;
    std::vector<double> falling; ///< see descend(); empty at its beginning
  };
} // namespace mortise
