// Jacobi's method among the displacements that satisfy the constraint: the
// inverse T of diag(K) becomes T - T B^T C^{-1} B T with C = B T B^T. It never
// looks at K.
// Sources: Braess, Sarazin (1997); Braess, Dahmen, Wieners (1999).
#pragma once

#include <mortise/solvers/diagonal_lifting.h>
#include <mortise/solvers/epetra_tools.h>

#include <vector>

namespace mortise
{
  /// Works on the few displacements that multipliers move.
  template <typename Number>
  class InterfaceCorrection
  {
  public:
    /// @p lifting must stay alive. Collective.
    InterfaceCorrection(const BlockSystem     &system,
                        const DiagonalLifting &lifting);

    /// subtract(i, c_i) with c = T B^T C^{-1} B T r, r_i = residual(i), for the
    /// places i of owned displacements that multipliers move. Collective.
    template <typename Residual, typename Subtract>
    void
    correct(const Residual &residual, const Subtract &subtract) const
    {
      for (const unsigned int i : places)
        values.local_element(i) = residual(i);
      apply();
      for (const unsigned int i : places)
        subtract(i, values.local_element(i));
    }

    /// x := P x = x - T B^T C^{-1} B x. Collective.
    void
    project(LevelVector<Number> &x) const;

    /// r := P^T r. Collective.
    void
    project_residual(LevelVector<Number> &r) const;

  private:
    /// values := T B^T C^{-1} B T values at the places.
    void
    apply() const;

    struct Group
    {
      RowGroup                  rows;    ///< of B
      std::vector<unsigned int> columns; ///< places, those of others behind
    };

    const DiagonalLifting                &lifting;
    std::vector<unsigned int>             places;
    std::vector<Number>                   diagonal; ///< of K, by place
    std::vector<Group>                    groups;
    dealii::AlignedVector<Number>         entries; ///< of B T, rows padded
    mutable dealii::AlignedVector<Number> gathered;
    mutable Epetra_Vector                 jump, multiplier;
    mutable LevelVector<Number>           values;
  };
} // namespace mortise
