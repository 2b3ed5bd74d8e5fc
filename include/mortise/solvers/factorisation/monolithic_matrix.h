// The saddle-point system of a scene as one matrix, in one numbering.
#pragma once

#include <mortise/base/sparse_matrix.h>
#include <mortise/solvers/scaled_residual.h>

#include <vector>

namespace mortise
{
  /// One numbering of (u, p, lambda), rank by rank: owned entries of u, then of
  /// p, then of lambda.
  class MonolithicNumbering
  {
  public:
    using Index = dealii::types::global_dof_index;

    enum Field
    {
      displacement,
      pressure,
      multiplier
    };
    static constexpr unsigned int n_fields = 3;

    /// Collective.
    explicit MonolithicNumbering(const BlockSystem &system);

    Index
    operator()(Field field, Index i) const;

    Index
    size() const
    {
      return n;
    }

    /// Of this rank.
    const dealii::IndexSet &
    owned() const
    {
      return owned_indices;
    }

  private:
    std::vector<Index> start[n_fields], shift[n_fields]; ///< by rank
    Index              n = 0;
    dealii::IndexSet   owned_indices;
  };

  /// [K G^T B^T; G -C 0; B 0 -S], with BlockSystem::force_rows in place of B^T
  /// where there are. Constrained dofs and inactive multipliers have a diagonal
  /// alone; the norm of @p residual is added to the diagonal of one pressure
  /// per free constant. Collective.
  SparseMatrix
  monolithic_matrix(const BlockSystem         &system,
                    const ScaledResidual      &residual,
                    const MonolithicNumbering &numbering);
} // namespace mortise
