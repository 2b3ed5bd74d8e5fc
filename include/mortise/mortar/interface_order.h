// Order in which interfaces that share displacements choose their multipliers,
// so that the constraints of all are independent.
#pragma once

#include <mortise/body/spaces/numbering.h>
#include <mortise/mortar/coupling.h>

#include <vector>

namespace mortise
{
  /// The constraints of all interfaces are linearly independent if each
  /// interface determines displacements of its slave that no earlier one
  /// couples: B is then block triangular. An interface couples its slave and
  /// the covered part of its master. A surface that is slave in one interface
  /// and master in another is therefore first used as slave. In a cycle, as
  /// around an edge that bodies share, and among interfaces with a common
  /// slave, the one that couples the smallest part of the other slaves is
  /// first.
  class InterfaceOrder
  {
  public:
    /// @p states: partner_states(couplings). Collective.
    InterfaceOrder(const std::vector<Coupling>                  &couplings,
                   const std::vector<std::vector<PartnerState>> &states,
                   const FieldNumbering                         &numbering,
                   MPI_Comm                                      comm);

    /// Numbers of the interfaces, independent of their order in the scene.
    const std::vector<unsigned int> &
    order() const
    {
      return sequence;
    }

    /// Mark the displacements that interface @p i couples as coupled.
    void
    add(unsigned int i)
    {
      if (!coupled_by.empty())
        for (const unsigned int k : coupled_by[i])
          is_coupled[k] = true;
    }

    /// By owned displacement of the scene.
    const std::vector<bool> &
    coupled() const
    {
      return is_coupled;
    }

    /// Those that interface @p i couples with themselves, positions among the
    /// owned displacements: on the axis about which a master is turned.
    std::vector<unsigned int>
    on_axis(unsigned int i) const;

  private:
    /// Positions among the owned displacements, ascending.
    using Displacements = std::vector<unsigned int>;

    void
    sort(const std::vector<Coupling> &couplings, MPI_Comm comm);

    std::vector<Displacements> slaves, masters, coupled_by; ///< by interface
    std::vector<unsigned int>  sequence;
    std::vector<bool>          is_coupled;
  };
} // namespace mortise
