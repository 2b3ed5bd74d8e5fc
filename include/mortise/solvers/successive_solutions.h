// Solutions of one linear system for earlier right hand sides, from which the
// next solve starts. Source: Fischer, Projection techniques for iterative
// solution of Ax = b with successive right-hand sides, Comput. Methods Appl.
// Mech. Engrg. 163 (1998).
#pragma once

#include <mortise/operators/block_system.h>
#include <mortise/solvers/scaled_residual.h>

#include <vector>

namespace mortise
{
  /// A basis of right hand sides, orthonormal in the product of ScaledResidual,
  /// and their solutions. Where loads are a few fields with factors that depend
  /// on time, start() is the solution as soon as there are as many.
  class SuccessiveSolutions
  {
  public:
    /// At most @p capacity are kept, two vectors of the system each; a further one starts anew.
    explicit SuccessiveSolutions(const unsigned int capacity)
      : capacity(capacity)
    {}

    bool
    empty() const
    {
      return basis.empty();
    }

    /// The combination of solutions whose right hand side comes nearest to @p rhs. Collective.
    SystemVector
    start(const SystemVector &rhs, const ScaledResidual &residual) const;

    /// @p x solves the system for @p rhs. Collective.
    void
    add(const SystemVector   &rhs,
        const SystemVector   &x,
        const ScaledResidual &residual);

  private:
    struct Pair
    {
      SystemVector rhs, x;
    };

    unsigned int      capacity;
    std::vector<Pair> basis;
  };
} // namespace mortise
