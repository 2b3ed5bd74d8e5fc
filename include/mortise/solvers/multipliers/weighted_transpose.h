// T B^T by rows, T diagonal, for the columns of owned rows of B, with the
// multipliers of all ranks.
#pragma once

#include <mortise/operators/levels/multigrid_level.h>
#include <mortise/solvers/multipliers/rows_by_entity.h>

#include <memory>
#include <utility>
#include <vector>

namespace mortise
{
  struct WeightedTranspose
  {
    using Entry = std::pair<int, double>; ///< multiplier, value

    /// @p weights: T by owned displacement. Collective.
    WeightedTranspose(const RowsByEntity        &B,
                      const LevelVector<double> &weights);

    /// Rows of B_c: owned ones, and those of others that entries refer to.
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> multipliers;
    std::vector<std::size_t> begin;   ///< by RowsByEntity::displacements
    std::vector<Entry>       entries; ///< multipliers by their local index
  };
} // namespace mortise
