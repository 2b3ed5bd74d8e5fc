// Owned rows of a symmetric matrix by node, the input of factorisations.
#pragma once

#include <mortise/base/sparse_matrix.h>

#include <utility>
#include <vector>

namespace mortise
{
  /// The components of the nodes do not couple with each other. Nodes are
  /// numbered rank by rank. A component that a node lacks has a diagonal, as
  /// large as the others, alone.
  struct RowsByNode
  {
    unsigned int n_components = 1;
    /// The local entry of a vector by node and component; -1: lacking.
    std::vector<int>          entries;
    std::vector<unsigned int> lengths; ///< by node
    std::vector<int>          columns; ///< by node: nodes, global
    /// By node: 1 if all components have the same values, else n_components.
    std::vector<unsigned int> variants;
    std::vector<double>       values; ///< by node, variant, column

    unsigned int
    size() const
    {
      return lengths.size();
    }
  };

  /// Each row of @p matrix as a node of one component; one without entries has
  /// a diagonal of one.
  RowsByNode
  rows_as_nodes(const SparseMatrix &matrix);

  /// matrix += @p other, whose rows are the nodes, of one component.
  void
  add(RowsByNode &matrix, const SparseMatrix &other);

  /// The matrix without off-diagonal entries of rows and columns that are not
  /// @p active, by local entry of a vector. Collective.
  RowsByNode
  select(const RowsByNode        &matrix,
         const std::vector<bool> &active,
         MPI_Comm                 comm);

  /// The nodes that couple with others; (entry, diagonal) of the others is
  /// added to @p uncoupled_entries. Collective.
  RowsByNode
  extract_coupled(const RowsByNode                    &matrix,
                  MPI_Comm                             comm,
                  std::vector<std::pair<int, double>> &uncoupled_entries);

  /// The matrix of these rows, numbered by node and component. Collective.
  SparseMatrix
  as_matrix(const RowsByNode &rows, MPI_Comm comm);

  /// y = A x, A = @p matrix = as_matrix(rows), for vectors with the entries of
  /// @p rows; other entries of y are zero. Collective.
  void
  multiply(const RowsByNode   &rows,
           const SparseMatrix &matrix,
           Vector             &y,
           const Vector       &x);
} // namespace mortise
