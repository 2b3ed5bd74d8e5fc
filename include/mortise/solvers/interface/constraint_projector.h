// The projector onto { u : B u = 0 } that the condensed system is written with.
#pragma once

#include <mortise/solvers/interface/coupling_product.h>
#include <mortise/solvers/interface/lifting.h>

namespace mortise
{
  /// P = I - T B^T C^{-1} B with C = B T B^T and T the lifting given.
  class ConstraintProjector
  {
  public:
    /// @p lifting must stay alive. @p rows: of system.coupling. Collective.
    ConstraintProjector(const BlockSystem  &system,
                        const CouplingRows &rows,
                        const Lifting      &lifting);

    /// r := P^T r = r - B^T y; lambda += y. Collective.
    void
    project_residual(Vector &r, Vector &lambda) const;

    /// Project @p u onto B u = g to rounding. Collective.
    void
    satisfy(Vector &u, const Vector &g) const;

    /// u := P u, or with @p g the projection onto B u = g: u - T B^T y. Returns y. Collective.
    const Vector &
    project(Vector &u, const Vector *g = nullptr) const;

  private:
    /// jump = B u.
    void
    apply(const Vector &u) const;

    const Lifting                &lifting;
    const CouplingProduct<double> product;
    mutable LevelVector<double>   trace;
    mutable Vector                jump, multiplier, force, correction;
  };
} // namespace mortise
