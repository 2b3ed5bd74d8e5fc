// p-multigrid: Chebyshev smoothers on the degrees p, lower_degree(p), ..., and
// VertexMultigrid on degree one. On the finest level smoothers act within the
// kernel of the constraint; coarse levels contain the penalties of
// MultigridLevel. With flat cells the only coarse level is ThicknessCoarsening.
#pragma once

#include <mortise/operators/block_system.h>
#include <mortise/solvers/multipliers/constraint_projector.h>

#include <memory>
#include <string>

namespace mortise
{
  /// Approximate inverse of K + B^T S^{-1} B of springs, symmetric and positive
  /// definite on the range of projector(), for conjugate gradients and GMRES.
  class DegreeMultigrid
  {
  public:
    /// @p system, which must have nodes, must stay alive. @p max_gathered: as in
    /// SolverOptions. Collective.
    DegreeMultigrid(const BlockSystem &system, std::size_t max_gathered);
    ~DegreeMultigrid();

    /// False on all ranks if the matrix is not positive definite or the
    /// multipliers are linearly dependent; nothing else may be called then.
    bool
    is_valid() const;

    /// After LinearSolver::update_active(); false as is_valid(). Collective.
    bool
    update_active();

    /// After LinearSolver::update_directions(); false as is_valid().
    /// Collective.
    bool
    update_directions();

    /// After LinearSolver::update_interfaces(); false as is_valid().
    /// Collective.
    bool
    update_interfaces();

    /// dst = approximate solution for src; dst and src are distinct.
    /// Collective.
    void
    vmult(Vector &dst, const Vector &src) const;

    /// Multipliers of springs for the last dst, zero for ties; only with
    /// springs.
    const Vector &
    spring_multipliers() const;

    /// Null without an interface.
    const ConstraintProjector *
    projector() const;

    /// The levels in words.
    std::string
    description() const;

  private:
    struct Implementation;
    template <typename Number>
    struct ImplementationOf;
    std::unique_ptr<Implementation> implementation;
  };
} // namespace mortise
