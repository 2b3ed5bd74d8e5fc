// Multigrid in the degree: Chebyshev smoothers on the degree and those of
// lower_degree(), the vertex functions by VertexMultigrid. On the finest level
// smoothers stay among what satisfies the constraint; the others see the tie by
// penalties (NodalLevel). Where bodies have flat cells, the functions of
// ThicknessCoarsening are the only other level.
#pragma once

#include <mortise/operators/block_system.h>
#include <mortise/solvers/multipliers/constraint_projector.h>

#include <memory>
#include <string>

namespace mortise
{
  /// An approximate inverse of the elasticity block, with the springs in it,
  /// symmetric and positive definite on what projector() leaves, hence usable
  /// between projections in conjugate gradients and GMRES.
  class DegreeMultigrid
  {
  public:
    /// @p system, which must have nodes, must stay alive. @p max_gathered: as in
    /// SolverOptions. Collective.
    DegreeMultigrid(const BlockSystem &system, std::size_t max_gathered);
    ~DegreeMultigrid();

    /// False, on every rank, when the matrix turned out not to be positive
    /// definite or the multipliers not to be independent; nothing else may be
    /// called then.
    bool
    is_valid() const;

    /// After LinearSolver::update_active(); false as is_valid(). Collective.
    bool
    update_active();

    /// After LinearSolver::update_interfaces(); false as is_valid().
    /// Collective.
    bool
    update_interfaces();

    /// dst = approximate solution for src; dst and src are distinct.
    /// Collective.
    void
    vmult(Vector &dst, const Vector &src) const;

    /// What springs carry for the last dst, zero for ties; with springs alone.
    const Vector &
    spring_multipliers() const;

    /// Null without an interface.
    const ConstraintProjector *
    projector() const;

    /// What was built, in words.
    std::string
    description() const;

  private:
    struct Implementation;
    template <typename Number>
    struct ImplementationOf;
    std::unique_ptr<Implementation> implementation;
  };
} // namespace mortise
