// The projector onto { u : B u = 0 } that the condensed system is written with.
// It never looks at K.
#pragma once

#include <mortise/operators/block_system.h>
#include <mortise/solvers/bulk_preconditioner.h>
#include <mortise/solvers/sparse_factorization.h>

namespace mortise
{
  /// P = I - T B^T C^{-1} B with C = B T B^T and T the lifting given.
  class ConstraintProjector
  {
  public:
    /// Both must stay alive. Collective.
    ConstraintProjector(const BlockSystem &system, const Lifting &lifting);

    /// False when the multipliers are not independent of each other.
    bool
    is_valid() const
    {
      return valid;
    }

    /// r := P^T r = r - B^T y; lambda += y. Collective.
    void
    project_residual(Vector &r, Vector &lambda) const;

    /// u := P u, or with @p g the projection onto B u = g: u - T B^T y. Returns y. Collective.
    const Vector &
    project(Vector &u, const Vector *g = nullptr) const;

  private:
    const BlockSystem  &system;
    const Lifting      &lifting;
    SparseFactorization inner;
    bool                valid = true;
    mutable Vector      jump, multiplier, force, correction;
  };
} // namespace mortise
