// The projector onto { u : B u = 0 } that the condensed system is written with.
#pragma once

#include <mortise/solvers/multipliers/approximate_schur_complement.h>
#include <mortise/solvers/multipliers/coupling_product.h>

#include <vector>

namespace mortise
{
  /// P = I - T B^T C^{-1} B with C = B T B^T + S and T of
  /// ApproximateSchurComplement. With lambda = C^{-1} B u, P u satisfies B P u
  /// = S lambda.
  class ConstraintProjector
  {
  public:
    /// @p schur must stay alive. @p rows: of system.directed_constraint(). Collective.
    ConstraintProjector(const BlockSystem                &system,
                        const RowsByEntity               &rows,
                        const ApproximateSchurComplement &schur);

    /// After LinearSolver::update_directions().
    void
    update_directions();

    /// Move from @p r to @p lambda the forces that multipliers of ties can
    /// balance: r := P^T r = r - B^T y, lambda += y, y = C^{-1} B T r; y = 0
    /// for springs, whose lambda follows from their opening. Collective.
    void
    remove_multipliers(Vector &r, Vector &lambda) const;

    /// Project @p u and the @p lambda of springs onto B u - S lambda = g to
    /// rounding. Collective.
    void
    satisfy(Vector &u, Vector &lambda, const Vector &g) const;

    /// Set the multipliers of ties to zero.
    void
    clear_ties(Vector &lambda) const
    {
      for (const unsigned int i : ties)
        lambda.local_element(i) = 0.;
    }

    /// u := P u, or with @p g the projection onto B u = g: u - T B^T y. Returns y. Collective.
    const Vector &
    project(Vector &u, const Vector *g = nullptr) const;

  private:
    void
    find_springs();
    /// jump = B u.
    void
    apply(const Vector &u) const
    {
      const auto &indices = product.indices();
      for (unsigned int k = 0; k < indices.size(); ++k)
        coupled_values.local_element(k) = u.local_element(indices[k]);
      product.multiply(jump, coupled_values);
    }
    /// multiplier = C^{-1} jump, u -= T B^T multiplier.
    void
    step_to_constraint(Vector &u) const;

    const BlockSystem                &system;
    std::vector<unsigned int>         ties, springs; ///< owned multipliers
    const ApproximateSchurComplement &schur;
    CouplingProduct<double>           product;
    mutable LevelVector<double>       coupled_values;
    mutable Vector                    jump, multiplier, force, correction;
  };
} // namespace mortise
