// Jacobi's method among the displacements that satisfy the constraint: the
// inverse T of diag(K) becomes T - T B^T C^{-1} B T with C = B T B^T. It never
// looks at K.
// Sources: Braess, Sarazin (1997); Braess, Dahmen, Wieners (1999).
#pragma once

#include <mortise/solvers/coupling_product.h>
#include <mortise/solvers/diagonal_lifting.h>

#include <vector>

namespace mortise
{
  /// Works on the few displacements that multipliers move.
  template <typename Number>
  class InterfaceCorrection
  {
  public:
    /// Both must stay alive. @p multipliers: rows of B. Collective.
    InterfaceCorrection(const CouplingProduct<Number> &product,
                        const DiagonalLifting         &lifting,
                        const Epetra_Map              &multipliers);

    /// subtract(i, c_i) with c = T B^T C^{-1} B T r, r_i = residual(i), for the
    /// places i of owned displacements that multipliers move. Collective.
    template <typename Residual, typename Subtract>
    void
    correct(const Residual &residual, const Subtract &subtract) const
    {
      const auto &places = product.places();
      for (unsigned int k = 0; k < places.size(); ++k)
        trace.local_element(k) = weights[k] * residual(places[k]);
      apply();
      for (unsigned int k = 0; k < places.size(); ++k)
        subtract(places[k], weights[k] * trace.local_element(k));
    }

    /// x := P x = x - T B^T C^{-1} B x. Collective.
    void
    project(LevelVector<Number> &x) const;

    /// r := P^T r. Collective.
    void
    project_residual(LevelVector<Number> &r) const;

  private:
    /// trace := B^T C^{-1} B trace.
    void
    apply() const;

    const CouplingProduct<Number> &product;
    const DiagonalLifting         &lifting;
    std::vector<Number>            weights; ///< T, by place
    mutable Epetra_Vector          jump, multiplier;
    mutable LevelVector<Number>    trace; ///< values at the places
  };
} // namespace mortise
