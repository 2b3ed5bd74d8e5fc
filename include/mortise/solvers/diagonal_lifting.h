// How a multiplier moves displacements where these are values at nodes: each
// node by itself. It never looks at levels below the finest.
#pragma once

#include <mortise/solvers/lifting.h>

namespace mortise
{
  /// T = diag(K)^{-1} on the nodes of interfaces.
  class DiagonalLifting : public Lifting
  {
  public:
    /// Collective.
    explicit DiagonalLifting(const BlockSystem &system);

    void
    vmult(Vector &dst, const Vector &src) const override;

    /// T by owned displacement.
    const LevelVector<double> &
    diagonal() const
    {
      return weights;
    }

  private:
    LevelVector<double> weights;
  };
} // namespace mortise
