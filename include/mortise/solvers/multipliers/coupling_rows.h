// The rows of B by entity and node, once for the components that share their
// entries, also where one of them lacks columns, since displacements are
// prescribed.
#pragma once

#include <mortise/solvers/multipliers/multiplier_nodes.h>

#include <array>
#include <vector>

namespace mortise
{
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
    explicit CouplingRows(const CouplingMatrix &B);

    /// Nodes that this rank's rows move: the columns of matrix.scalar().
    unsigned int
    n_nodes() const
    {
      return matrix.scalar().n_columns();
    }

    const CouplingMatrix &matrix;
    /// By node and component: the displacement, of any rank; -1: it is
    /// prescribed.
    std::vector<int>                     displacements;
    MultiplierNodes                      multipliers;
    std::vector<std::vector<SharedRows>> rows; ///< by entity
  };
} // namespace mortise
