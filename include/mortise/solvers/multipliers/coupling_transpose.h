// T B^T by rows, T diagonal, for the columns of owned rows of B, with the
// multipliers of all ranks.
#pragma once

#include <mortise/operators/levels/nodal_level.h>
#include <mortise/solvers/multipliers/coupling_rows.h>

#include <memory>
#include <utility>
#include <vector>

namespace mortise
{
  struct CouplingTranspose
  {
    using Entry = std::pair<int, double>; ///< multiplier, value

    /// @p weights: T by owned displacement. Collective.
    CouplingTranspose(const CouplingRows        &B,
                      const LevelVector<double> &weights);

    /// Rows of B_c: owned ones, and those of others that entries refer to.
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> multipliers;
    std::vector<std::size_t> begin;   ///< by CouplingRows::displacements
    std::vector<Entry>       entries; ///< multipliers by their local index
  };
} // namespace mortise
