// Grouping of the rows of B into dense blocks and single entries for
// CouplingProduct.
#pragma once

#include <deal.II/base/index_set.h>

#include <mortise/operators/block_system.h>
#include <mortise/solvers/multipliers/rows_by_entity.h>

#include <array>
#include <vector>

namespace mortise
{
  /// Columns of owned rows of B in the numbering of the system.
  dealii::IndexSet
  coupled_displacements(const BlockSystem &system, const RowsByEntity &rows);

  /// By node of the columns: are all its components independent? Collective.
  std::vector<bool>
  independent_nodes(const BlockSystem &system, const RowsByEntity &rows);

  /// The EntityRows as a dense part and single entries.
  struct SplitEntityRows
  {
    /// @p is_independent: independent_nodes().
    SplitEntityRows(const EntityRows        &shared,
                    const std::vector<bool> &is_independent);

    const EntityRows *shared;
    /// By row: the column among shared->nodes of its only dependent node; -1:
    /// there are several.
    std::vector<int> own;
    /// Columns of the dense part: of dependent, then of independent nodes.
    std::array<std::vector<unsigned int>, 2> columns;
  };

  /// Neighbouring rows with nearly the same nodes, which form one block.
  struct CouplingCluster
  {
    std::size_t begin = 0, end = 0; ///< of shared rows
    int         n_rows = 0;
    std::array<std::vector<unsigned int>, 2>
      nodes; ///< ascending; dependent, independent

    /// Add @p rows unless separate blocks cost less; true if added.
    bool
    add(const SplitEntityRows &rows);
  };

  std::vector<CouplingCluster>
  make_clusters(const std::vector<SplitEntityRows> &all);
} // namespace mortise
