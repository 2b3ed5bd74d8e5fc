// Jacobi's method in the kernel of the constraint: D^{-1} becomes P D^{-1} P^T,
// P = I - T B^T C^{-1} B, C = B T B^T. Sources: Braess, Sarazin (1997); Braess,
// Dahmen, Wieners (1999).
#pragma once

#include <mortise/solvers/multipliers/approximate_schur_complement.h>
#include <mortise/solvers/multipliers/coupling_product.h>

#include <vector>

namespace mortise
{
  /// Works on the displacements with a column in B. Without independent ones T
  /// = D^{-1} and P D^{-1} P^T = T - T B^T C^{-1} B T.
  template <typename Number>
  class InterfaceCorrection
  {
  public:
    /// @p product and @p schur must stay alive. Collective.
    InterfaceCorrection(const BlockSystem                &system,
                        const CouplingProduct<Number>    &product,
                        const ApproximateSchurComplement &schur);

    /// Are there independent displacements on any rank?
    bool
    has_independent() const
    {
      return any_independent;
    }

    /// Add IndependentDisplacement::dependent_stiffness to the diagonal of K.
    void
    add_dependent_stiffness(LevelVector<Number> &diagonal) const;

    /// subtract(i, c_i) with c = (D^{-1} - P D^{-1} P^T) r, r_i = residual(i),
    /// for the owned displacements i with a column in B. @p inverse: D^{-1}.
    /// Collective.
    template <typename Residual, typename Subtract>
    void
    correct(const Residual            &residual,
            const LevelVector<Number> &inverse,
            const Subtract            &subtract) const
    {
      const auto        &indices = product.indices();
      const unsigned int n       = indices.size();
      for (unsigned int k = 0; k < n; ++k)
        coupled_values.local_element(k) = weights[k] * residual(indices[k]);
      apply(CoupledNodes::dependent, CoupledNodes::all);
      if (any_independent)
        {
          for (unsigned int k = 0; k < n; ++k)
            coupled_values.local_element(k) = smoothed[k] =
              inverse.local_element(indices[k]) *
              (residual(indices[k]) - coupled_values.local_element(k));
          apply(CoupledNodes::all, CoupledNodes::dependent);
          for (unsigned int k = 0; k < n; ++k)
            subtract(indices[k],
                     inverse.local_element(indices[k]) * residual(indices[k]) -
                       smoothed[k] +
                       weights[k] * coupled_values.local_element(k));
        }
      else
        for (unsigned int k = 0; k < n; ++k)
          subtract(indices[k], weights[k] * coupled_values.local_element(k));
    }

    /// x := x - T B^T y, y = C^{-1} (B x - S lambda), and add y to lambda, the
    /// multipliers of springs. Collective.
    void
    project(LevelVector<Number> &x) const;

    /// Set the multipliers of springs to zero. They are kept beside the x of a
    /// smoother, since the opening of a stiff spring is less than the rounding
    /// of x.
    void
    release_springs() const
    {
      carried = 0.;
    }

    /// Add d := keep d + take y to the multipliers of springs, y those of the
    /// last correct().
    void
    load_springs(double keep, double take) const
    {
      added.sadd(keep, take, multiplier);
      carried += added;
    }

    /// r += B^T lambda of springs. Collective.
    void
    add_spring_forces(LevelVector<Number> &r) const
    {
      product.multiply_transposed(coupled_values, carried);
      const auto &indices = product.indices();
      for (unsigned int k = 0; k < indices.size(); ++k)
        r.local_element(indices[k]) += coupled_values.local_element(k);
    }

    const Vector &
    carried_by_springs() const
    {
      return carried;
    }

    bool
    has_springs() const
    {
      return system.has_springs();
    }

    /// r := P^T r. Collective.
    void
    project_residual(LevelVector<Number> &r) const;

  private:
    /// trace := B^T C^{-1} B trace, nonzero at @p from, needed at @p to.
    void
    apply(CoupledNodes from, CoupledNodes to) const
    {
      product.multiply(jump, coupled_values, from);
      schur.apply_inverse(multiplier, jump);
      product.multiply_transposed(coupled_values, multiplier, to);
    }

    const BlockSystem                &system;
    const CouplingProduct<Number>    &product;
    const ApproximateSchurComplement &schur;
    std::vector<Number>               weights;                 ///< T, by index
    bool                              any_independent = false; ///< on some rank
    mutable Vector                    jump, multiplier;
    mutable Vector                    carried, added; ///< by springs
    mutable LevelVector<Number>       coupled_values; ///< values at the indices
    mutable std::vector<Number>       smoothed;       ///< likewise
  };
} // namespace mortise
