// The rows of B by node: multipliers of one component each that belong
// together.
#pragma once

#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>
#include <mortise/solvers/epetra_tools.h>

#include <vector>

namespace mortise
{
  /// Rows of B with the same columns and the nodes that they belong to.
  struct NodeGroup
  {
    RowGroup     rows;
    int          node      = 0; ///< of the first row
    unsigned int component = 0;
  };

  /// The nodes of one entity.
  struct EntityNodes
  {
    int                    first = 0, n_nodes = 0;
    std::vector<NodeGroup> groups;
  };

  /// The owned rows by entity: a component that does not follow the one
  /// before begins another. What rows stand for does not matter, only that
  /// each node has one row of a component at most.
  std::vector<EntityNodes>
  group_by_entity(const Epetra_CrsMatrix &B);

  /// Owned nodes, by their number on this rank, and others behind them.
  struct NodeNumbers
  {
    std::vector<int> of_column; ///< by column given
    std::vector<int> global;
  };

  /// @p rows: of B. @p columns: multipliers, those of other ranks among them.
  /// Collective.
  NodeNumbers
  number_nodes(const std::vector<EntityNodes> &entities,
               const Epetra_Map               &rows,
               const Epetra_BlockMap          &columns);
} // namespace mortise
