// Which rows of B are one dense block of a CouplingProduct, and which entries
// stand by themselves.
#pragma once

#include <deal.II/base/index_set.h>

#include <mortise/operators/block_system.h>
#include <mortise/solvers/multipliers/coupling_rows.h>

#include <array>
#include <vector>

namespace mortise
{
  /// The displacements that owned rows move, in the numbering of the system.
  dealii::IndexSet
  touched_displacements(const BlockSystem &system, const CouplingRows &rows);

  /// Of the nodes that rows move: do all their components lead? Collective.
  std::vector<bool>
  leading_nodes(const BlockSystem &system, const CouplingRows &rows);

  /// Shared rows with their dense part and what stands by itself.
  struct SplitRows
  {
    /// @p leads: leading_nodes().
    SplitRows(const SharedRows &shared, const std::vector<bool> &leads);

    const SharedRows *shared;
    /// By row: the column among shared->nodes of the only node that follows;
    /// -1: there are several.
    std::vector<int> own;
    /// Columns of the dense part: those of nodes that follow, and of nodes
    /// that lead.
    std::array<std::vector<unsigned int>, 2> columns;
  };

  /// Neighbouring rows that are one block, since they move nearly the same
  /// nodes.
  struct CouplingCluster
  {
    std::size_t begin = 0, end = 0; ///< of shared rows
    int         n_rows = 0;
    std::array<std::vector<unsigned int>, 2>
      nodes; ///< ascending; that follow, that lead

    /// Unless that takes longer than apart.
    bool
    add(const SplitRows &rows);
  };

  std::vector<CouplingCluster>
  make_clusters(const std::vector<SplitRows> &all);
} // namespace mortise
