// Dirichlet boundaries: components and nodes with prescribed displacements, and
// forces of multipliers on the other ones.
#pragma once

#include <mortise/problem/scene/discretisation.h>

#include <array>
#include <map>
#include <optional>
#include <vector>

namespace mortise
{
  /// Components that the boundaries of bodies prescribe, and the nodes there.
  class DirichletBoundaries
  {
  public:
    using Components = std::array<bool, dim>;

    /// Kept by reference. Collective.
    explicit DirichletBoundaries(const Discretisation &discretisation);

    /// Prescribed components of @p boundary of body @p body.
    Components
    components(unsigned int body, dealii::types::boundary_id boundary) const
    {
      const auto found = prescribed[body].find(boundary);
      return found == prescribed[body].end() ? Components() : found->second;
    }

    /// By body: boundaries with prescribed components.
    const std::vector<std::map<dealii::types::boundary_id, Components>> &
    all() const
    {
      return prescribed;
    }

    /// By component of a node: the number of boundaries that prescribe it.
    const LevelVector<double> &
    numbers() const
    {
      return n_prescribing;
    }

    /// Is a component of a node prescribed by several boundaries?
    bool
    any_shared() const
    {
      return shared;
    }

    /// B^T lambda of interface @p i alone, by node. Collective.
    LevelVector<double>
    forces_of(unsigned int i, const Vector &lambda) const;

    /// B^T lambda by node, zero at components that the side of the interface
    /// prescribes, whose boundary bears them. Collective.
    LevelVector<double>
    multiplier_forces(const Vector &lambda) const;

    /// Set @p multiplier to B u with this B. Collective.
    void
    constraint(const LevelVector<double> &u, Vector &multiplier) const;

  private:
    /// 1 at components that @p side prescribes, if any.
    std::optional<LevelVector<double>>
    prescribed_by_side(const SideParameters &side) const;

    const Discretisation &discretisation;
    std::vector<std::map<dealii::types::boundary_id, Components>> prescribed;
    LevelVector<double>                                           n_prescribing;
    bool shared = false;
  };

  /// The nodes of displacements.
  const MultigridLevel &
  nodes_of(const Discretisation &discretisation);

  LevelVector<double>
  zero_at_nodes(const Discretisation &discretisation);

  /// 1 at the components @p which of the nodes on @p boundary of body @p body,
  /// see boundary_nodes(). Collective.
  LevelVector<double>
  nodes_with(const Discretisation                  &discretisation,
             unsigned int                           body,
             dealii::types::boundary_id             boundary,
             const DirichletBoundaries::Components &which);

  /// Owned entries of coupling @p i alone, others zero.
  Vector
  part_of(const Discretisation &discretisation,
          const Vector         &multiplier,
          unsigned int          i);

  /// Calls visit(interface, side) for the sides of all interfaces; a support
  /// has one.
  template <typename Visit>
  void
  for_each_side(const Discretisation &discretisation, const Visit &visit)
  {
    const auto &interfaces = discretisation.interfaces().sides();
    for (unsigned int i = 0; i < interfaces.size(); ++i)
      {
        visit(i, interfaces[i].slave);
        if (!interfaces[i].is_support)
          visit(i, interfaces[i].master);
      }
  }
} // namespace mortise
