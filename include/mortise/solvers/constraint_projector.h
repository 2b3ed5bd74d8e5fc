// The projector onto { u : B u = 0 } that the condensed system is written with. It never looks at K.
#pragma once

#include <mortise/operators/block_system.h>
#include <mortise/solvers/sparse_factorization.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Vector.h>

#include <memory>

namespace mortise
{
  /// P = I - T B^T (B T B^T)^{-1} B with a diagonal T >= 0: P u is the point of the subspace that is nearest
  /// to u in the norm of T^{-1}; a dof without weight in T stays as it is.
  class ConstraintProjector
  {
  public:
    /// @p weights: diagonal of T on the owned displacements; positive wherever B has a column that
    /// is not zero. Collective.
    ConstraintProjector(const BlockSystem &system, const Vector &weights);

    /// False when the multipliers are not independent of each other.
    bool
    is_valid() const
    {
      return valid;
    }

    /// r := P^T r = r - B^T y; lambda += y. Collective.
    void
    project_residual(Vector &r, Vector &lambda) const;

    /// u := P u, or with @p g the nearest vector with B u = g. Collective.
    void
    project(Vector &u, const Vector *g = nullptr) const;

  private:
    const BlockSystem                &system;
    bool                              valid = true;
    Vector                            weight;
    mutable Vector                    jump, multiplier, correction;
    std::unique_ptr<Epetra_CrsMatrix> inner_matrix;
    SparseFactorization               inner;
  };
} // namespace mortise
