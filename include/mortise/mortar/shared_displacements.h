// Displacements that several interfaces of a scene move: which interface goes
// first in choosing those that its multipliers determine, and which are then
// taken.
#pragma once

#include <mortise/body/spaces/numbering.h>
#include <mortise/mortar/coupling.h>

#include <vector>

namespace mortise
{
  /// The constraints of all interfaces are independent of each other if each
  /// interface determines displacements of its slave that none before it moves:
  /// the matrix is then triangular by blocks. What an interface moves is the
  /// slave and the part of the master that it meets. So where a surface is
  /// slave in one interface and master in another, the former goes first;
  /// where interfaces go round in circles, as around an edge that bodies share,
  /// or share a slave, the one that takes the least part of others does.
  class SharedDisplacements
  {
  public:
    /// @p states: partner_states(couplings). Collective.
    SharedDisplacements(const std::vector<Coupling>                  &couplings,
                        const std::vector<std::vector<PartnerState>> &states,
                        const FieldNumbering                         &numbering,
                        MPI_Comm                                      comm);

    /// Numbers of the interfaces; whatever order they are given in, it is the
    /// same.
    const std::vector<unsigned int> &
    order() const
    {
      return sequence;
    }

    /// What interface @p i moves is taken from now on.
    void
    take(unsigned int i)
    {
      if (!moved.empty())
        for (const unsigned int k : moved[i])
          is_taken[k] = true;
    }

    /// By owned displacement of the scene.
    const std::vector<bool> &
    taken() const
    {
      return is_taken;
    }

  private:
    /// Positions among the owned displacements, ascending.
    using Displacements = std::vector<unsigned int>;

    void
    sort(const std::vector<Coupling> &couplings, MPI_Comm comm);

    std::vector<Displacements> slaves, moved; ///< by interface
    std::vector<unsigned int>  sequence;
    std::vector<bool>          is_taken;
  };
} // namespace mortise
