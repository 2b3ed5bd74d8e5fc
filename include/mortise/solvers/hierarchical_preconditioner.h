// An approximate inverse of the elasticity block A = K + J that uses the
// hierarchy of the element: algebraic multigrid on the vertex functions, block
// smoothers on the higher modes, right for degrees 1 to 8. It never looks at
// the multipliers.
#pragma once

#include <mortise/operators/block_system.h>
#include <mortise/solvers/block_smoother.h>

#include <memory>
#include <string>

namespace mortise
{
  /// Symmetric and positive definite, hence usable in conjugate gradients and
  /// GMRES.
  class HierarchicalPreconditioner
  {
  public:
    HierarchicalPreconditioner();
    ~HierarchicalPreconditioner();

    /// Build for A = K + J of @p system (A = K without an interface). Collective. False, on every
    /// rank, when A turned out not to be positive definite; vmult() must not be
    /// called then.
    bool
    initialize(const BlockSystem &system);

    /// dst = A^{-1} src, approximately; dst and src are distinct.
    void
    vmult(Vector &dst, const Vector &src) const;

    /// The patches of A; only with an interface or above degree 1.
    const BlockSmoother &
    smoother() const;

    /// What was built, in words.
    std::string
    description() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation;
  };
} // namespace mortise
