// How a multiplier moves displacements where these are values at nodes: each
// node by itself.
#pragma once

#include <mortise/solvers/interface/coupling_product.h>
#include <mortise/solvers/interface/lifting.h>

namespace mortise
{
  /// T = diag(K)^{-1} on the nodes of interfaces but zero for leading
  /// displacements; one value for a node, so that multipliers of all
  /// components see the same wherever no boundary condition tells them apart.
  /// Iterations are the same or up to 3 in 19 fewer than with a value for each
  /// component.
  class DiagonalLifting : public Lifting
  {
  public:
    /// @p system, @p product must stay alive. @p max_gathered: as in SolverOptions.
    /// Collective.
    DiagonalLifting(const BlockSystem            &system,
                    const CouplingRows           &rows,
                    const CouplingProduct<float> &product,
                    std::size_t                   max_gathered);

    /// After other multipliers have become active. False as is_valid(). Collective.
    bool
    update_active();

    void
    vmult(Vector &dst, const Vector &src) const override;

    /// T by owned displacement.
    const LevelVector<double> &
    diagonal() const
    {
      return weights;
    }

  private:
    /// Factorise @p active rows and columns of C.
    void
    factorise_active(NodalMatrix active);

    const CouplingProduct<float> &product;
    const std::size_t             max_gathered;
    LevelVector<double>           weights;
    NodalMatrix schur; ///< kept once not all multipliers are active
  };
} // namespace mortise
