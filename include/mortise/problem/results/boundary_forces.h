// What a body bears across its boundaries, from the balance of nodes: K u + G^T
// p less the loads that are given elsewhere, tested with the functions of the
// boundary. It is exact on any mesh and of any degree as far as the balance of
// the whole body goes, where the integral of stresses is as accurate as these.
//
// Where several boundaries prescribe the same component at a node they share
// it: each gets what stresses say, and the same part of what these miss.
// Source: Melbo and Kvamsdal, Goal oriented error estimators for Stokes
// equations based on variationally consistent postprocessing (2003).
#pragma once

#include <mortise/problem/results/held_boundaries.h>
#include <mortise/problem/results/solved_step.h>

#include <vector>

namespace mortise
{
  struct ForceAndMoment
  {
    dealii::Tensor<1, dim> force;
    dealii::Tensor<1, dim> moment; ///< force times length
  };

  class BoundaryForces
  {
  public:
    /// All are kept by reference. Collective.
    BoundaryForces(const Discretisation            &discretisation,
                   const SolvedStep                &solved,
                   const std::vector<BodySolution> &solutions);

    /// What acts on body @p body across @p boundary: loads, supports and interfaces there, about
    /// @p point. Collective.
    ForceAndMoment
    on(unsigned int               body,
       dealii::types::boundary_id boundary,
       const dealii::Point<dim>  &point) const;

    /// All loads, and all that supports bear. Collective.
    EquilibriumSummary
    equilibrium() const;

  private:
    /// int (sigma n) . v over @p boundary by node, for the components @p which of the
    /// nodes there.
    LevelVector<double>
    stresses_at_nodes(unsigned int                      b,
                      dealii::types::boundary_id        boundary,
                      const HeldBoundaries::Components &which) const;
    /// What passes through @p boundary where it prescribes components.
    void
    add_borne(unsigned int               b,
              dealii::types::boundary_id boundary,
              LevelVector<double>       &forces) const;
    /// What interfaces put on it where it does not.
    void
    add_interfaces(unsigned int               b,
                   dealii::types::boundary_id boundary,
                   LevelVector<double>       &forces) const;

    const Discretisation                       &discretisation;
    const SolvedStep                           &solved;
    const std::vector<BodySolution>            &solutions;
    const HeldBoundaries                        held;
    std::vector<std::vector<TractionCondition>> tractions; ///< by body
    /// What passes through boundaries that prescribe it, less what stresses say
    /// where they share a node.
    LevelVector<double>    borne;
    LevelVector<double>    reactions; ///< of constrained components
    dealii::Tensor<1, dim> applied;
  };

  /// A linear functional of what is solved for, and of what is prescribed.
  struct LinearFunctional
  {
    SystemVector rhs;
    /// Values at nodes where components are constrained: the functional is the
    /// energy product with the function that has them.
    Vector lift;
  };

  /// Component @p c of what BoundaryForces::on() has for a force, less what does not depend on the
  /// solution. Collective.
  LinearFunctional
  reaction_functional(const Discretisation      &discretisation,
                      unsigned int               body,
                      dealii::types::boundary_id boundary,
                      unsigned int               c);
} // namespace mortise
