// The rows of B by entity and node, once for the components that have the same
// entries, also where one of them lacks columns, since displacements are
// prescribed.
#pragma once

#include <Epetra_CrsMatrix.h>
#include <mortise/base/types.h>
#include <mortise/solvers/interface/multiplier_nodes.h>

#include <array>
#include <vector>

namespace mortise
{
  /// What the columns of B stand for.
  struct CouplingColumns
  {
    CouplingColumns(const Epetra_CrsMatrix &B, unsigned int n_components);

    unsigned int n_components;
    unsigned int n_nodes = 0;

    /// n_components * node + component by local column; -1: it has no entries.
    std::vector<int> value_of_column;

    /// By node and component: its column; -1: it has none or no entries.
    std::vector<int> column_of_value;
  };

  /// Rows of neighbouring multiplier nodes, for some components or all.
  struct SharedRows
  {
    int                       first_node = 0;              ///< see NodeGroup
    int                       n_rows     = 0;              ///< of a component
    std::array<int, dim>      first_row  = {{-1, -1, -1}}; ///< -1: none
    std::vector<unsigned int> nodes;  ///< that they move, ascending
    std::vector<double>       values; ///< by row and node
  };

  /// All owned rows. Multipliers of a component move displacements of this
  /// component only. Rows of several components share their entries
  /// (SharedRows) also where a displacement of one component is prescribed: its
  /// column is zero in all rows, so it may stand in those of the others.
  struct CouplingRows
  {
    /// @p by_node: displacements are numbered by node, the three components one
    /// after the other, multipliers by entity of the mesh, in it by component.
    /// Otherwise each displacement is a node of one component, each row with
    /// other columns than the one before an entity.
    CouplingRows(const Epetra_CrsMatrix &B, bool by_node);

    const Epetra_CrsMatrix              &matrix;
    CouplingColumns                      moved;
    std::vector<EntityNodes>             entities;
    std::vector<std::vector<SharedRows>> rows; ///< by entity
  };
} // namespace mortise
