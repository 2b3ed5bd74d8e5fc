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
  /// and their solutions. If loads are n fields with factors in time, start()
  /// is the solution from step n + 1 on.
  class SuccessiveSolutions
  {
  public:
    /// At most @p capacity pairs are kept, two vectors of the system each; a
    /// further one replaces all.
    explicit SuccessiveSolutions(const unsigned int capacity)
      : capacity(capacity)
    {}

    bool
    empty() const
    {
      return basis.empty();
    }

    void
    clear()
    {
      basis.clear();
    }

    /// The combination of solutions with the right hand side nearest to @p rhs.
    /// Collective.
    SystemVector
    start(const SystemVector &rhs, const ScaledResidual &residual) const;

    /// Add @p x, the solution for @p rhs. Collective.
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
