// The rows of B by entity and node, once for the components that share their
// entries, also where one of them lacks columns, since displacements are
// prescribed.
#pragma once

#include <mortise/solvers/interface/multiplier_nodes.h>

#include <array>
#include <vector>

namespace mortise
{
  /// What the columns of B stand for.
  struct CouplingColumns
  {
    explicit CouplingColumns(const CouplingMatrix &B);

    unsigned int n_nodes = 0;

    /// By local column of the matrix; -1: it has no entries.
    std::vector<int> node_of_column;

    /// By node and component: the displacement, of any rank; -1: it is
    /// prescribed.
    std::vector<int> displacements;
  };

  /// Rows of neighbouring multiplier nodes, for some components or all.
  struct SharedRows
  {
    int                       first_node = 0; ///< see MultiplierNodes
    int                       n_rows     = 0; ///< of a component
    std::array<int, dim>      first_row  = {{-1, -1, -1}}; ///< -1: none
    std::vector<unsigned int> nodes;  ///< that they move, ascending
    std::vector<double>       values; ///< by row and node
  };

  /// All owned rows. Multipliers of a component move displacements of this
  /// component only. Rows of several components share their entries
  /// (SharedRows) also where a displacement of one component is prescribed.
  struct CouplingRows
  {
    /// @p B: by node.
    explicit CouplingRows(const CouplingMatrix &B);

    const CouplingMatrix                &matrix;
    CouplingColumns                      moved;
    MultiplierNodes                      multipliers;
    std::vector<std::vector<SharedRows>> rows; ///< by entity
  };
} // namespace mortise
