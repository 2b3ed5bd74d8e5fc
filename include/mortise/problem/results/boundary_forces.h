// Forces on the boundaries of bodies from the balance of nodes: K u + G^T p
// less the loads given elsewhere, tested with the functions of the boundary.
// Unlike integrals of stresses they balance exactly on any mesh and with any
// degree.
//
// Boundaries that prescribe the same component at a node share its force: each
// has the integral of its stresses and an equal part of the rest. Source: Melbo
// and Kvamsdal, Goal oriented error estimators for Stokes equations based on
// variationally consistent postprocessing (2003).
#pragma once

#include <mortise/problem/results/dirichlet_boundaries.h>
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

    /// Force and moment about @p point on body @p body across @p boundary, of
    /// loads, supports and interfaces there; forces act at deformed positions
    /// if the body has finite strains. Collective.
    ForceAndMoment
    on(unsigned int               body,
       dealii::types::boundary_id boundary,
       const dealii::Point<dim>  &point) const;

    /// What the displacement of a slave with finite strains adds to the moment
    /// that interface @p i carries to the master. Collective.
    dealii::Tensor<1, dim>
    moment_of_displacement(unsigned int i) const;

    /// Sums of loads and reactions. Collective.
    EquilibriumSummary
    equilibrium() const;

  private:
    /// int (sigma n) . v over @p boundary by node, for the components @p which of the
    /// nodes there.
    LevelVector<double>
    stresses_at_nodes(unsigned int                           b,
                      dealii::types::boundary_id             boundary,
                      const DirichletBoundaries::Components &which) const;
    /// Add forces at components that @p boundary prescribes.
    void
    add_borne(unsigned int               b,
              dealii::types::boundary_id boundary,
              LevelVector<double>       &forces) const;
    /// Add forces of interfaces at its other components.
    void
    add_interfaces(unsigned int               b,
                   dealii::types::boundary_id boundary,
                   LevelVector<double>       &forces) const;

    const Discretisation                       &discretisation;
    const SolvedStep                           &solved;
    const std::vector<BodySolution>            &solutions;
    const DirichletBoundaries                   dirichlet;
    std::vector<std::vector<TractionCondition>> tractions; ///< by body
    /// Forces on prescribing boundaries, at shared nodes less those of
    /// stresses.
    LevelVector<double>    borne;
    LevelVector<double>    reactions; ///< of constrained components
    dealii::Tensor<1, dim> applied;
    dealii::Tensor<1, dim> on_rigid_parts; ///< of them: at reference points
  };

  /// A linear functional of unknowns and prescribed values.
  struct LinearFunctional
  {
    SystemVector rhs;
    /// Values at constrained components: the functional is the energy product
    /// with their lifting.
    Vector lift;
  };

  /// The derivative of component @p c of the force of BoundaryForces::on() at
  /// @p solutions, where the scene is linearised. Collective.
  LinearFunctional
  reaction_functional(const Discretisation            &discretisation,
                      const std::vector<BodySolution> &solutions,
                      unsigned int                     body,
                      dealii::types::boundary_id       boundary,
                      unsigned int                     c);
} // namespace mortise
