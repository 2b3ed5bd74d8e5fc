// The rows of B by entity and node, once for all components with the same
// entries.
#pragma once

#include <mortise/solvers/multipliers/multiplier_nodes.h>

#include <array>
#include <vector>

namespace mortise
{
  /// Rows of neighbouring multiplier nodes, for some components or all.
  struct EntityRows
  {
    int                       first_node = 0; ///< see MultiplierNodes
    int                       n_rows     = 0; ///< of a component
    std::array<int, dim>      first_row  = {{-1, -1, -1}}; ///< -1: none
    std::vector<unsigned int> nodes;  ///< that they move, ascending
    std::vector<double>       values; ///< by row and node
  };

  /// All owned rows. A row has columns of its component only. Components share
  /// entries (EntityRows) even if displacements of one are prescribed.
  struct RowsByEntity
  {
    explicit RowsByEntity(const CouplingMatrix &B);

    /// Number of nodes of the columns, those of matrix.scalar().
    unsigned int
    n_nodes() const
    {
      return matrix.scalar().n_columns();
    }

    const CouplingMatrix &matrix;
    /// By node and component: the displacement, of any rank; -1: prescribed.
    std::vector<int>                     displacements;
    MultiplierNodes                      multipliers;
    std::vector<std::vector<EntityRows>> rows; ///< by entity
  };
} // namespace mortise
