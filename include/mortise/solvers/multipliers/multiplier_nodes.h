// Grouping of the rows of B by node: the multipliers of its components.
#pragma once

#include <deal.II/base/partitioner.h>

#include <mortise/mortar/coupling_matrix.h>

#include <memory>
#include <vector>

namespace mortise
{
  /// The nodes of one entity of the mesh, numbered on this rank.
  struct EntityNodes
  {
    int first = 0, n_nodes = 0;
    int first_row = 0, n_rows = 0; ///< of all components
  };

  /// The owned rows of B_c by entity, which ends where the component decreases.
  /// Each node has at most one row per component.
  struct MultiplierNodes
  {
    explicit MultiplierNodes(const CouplingMatrix &B);

    int
    size() const
    {
      return entities.empty() ? 0 :
                                entities.back().first + entities.back().n_nodes;
    }

    std::vector<EntityNodes> entities;
    std::vector<int>         node_of_row;
  };

  /// Owned nodes, by their number on this rank, and others behind them.
  struct NodeNumbers
  {
    std::vector<int> of_column; ///< by column given
    std::vector<int> global;
  };

  /// @p rows: of B_c, those of other ranks among them, which are the columns. Collective.
  NodeNumbers
  number_nodes(
    const MultiplierNodes                                            &nodes,
    const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> &rows);
} // namespace mortise
