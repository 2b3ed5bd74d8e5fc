// Rows of a symmetric matrix by node: what a factorisation is made of. It never
// refers to the matrix that it came from.
#pragma once

#include <mortise/base/sparse_matrix.h>

#include <utility>
#include <vector>

namespace mortise
{
  /// The owned rows of a matrix whose nodes have a number of components that do
  /// not couple with each other. Nodes of a rank are numbered behind those of
  /// the rank before. A component that a node lacks has a row that is zero but
  /// for a diagonal as large as the others'.
  struct NodalMatrix
  {
    unsigned int n_components = 1;
    /// The local entry of a vector by node and component; -1: lacking.
    std::vector<int>          entries;
    std::vector<unsigned int> lengths; ///< by node
    std::vector<int>          columns; ///< by node: nodes, global
    /// By node: 1 where all components have the same values, else n_components.
    std::vector<unsigned int> variants;
    std::vector<double>       values; ///< by node, variant, column

    unsigned int
    size() const
    {
      return lengths.size();
    }
  };

  /// Each row of @p matrix as a node of one component.
  NodalMatrix
  rows_as_nodes(const SparseMatrix &matrix);

  /// matrix += @p other, whose rows are nodes of one component in the same
  /// order.
  void
  add(NodalMatrix &matrix, const SparseMatrix &other);

  /// Without the off-diagonal entries of rows and columns that are not @p active, by local entry of
  /// a vector. Collective.
  NodalMatrix
  select(const NodalMatrix       &matrix,
         const std::vector<bool> &active,
         MPI_Comm                 comm);

  /// The nodes that couple with others. (Entry, diagonal) of what is left goes
  /// to
  /// @p lone. Collective.
  NodalMatrix
  take_coupled(const NodalMatrix                   &matrix,
               MPI_Comm                             comm,
               std::vector<std::pair<int, double>> &lone);

  /// The matrix of these rows, numbered by node and component. Collective.
  SparseMatrix
  as_matrix(const NodalMatrix &rows, MPI_Comm comm);

  /// y = A x with A = @p matrix = as_matrix(rows), both vectors with the entries of @p rows; y is
  /// zero where there are none. Collective.
  void
  multiply(const NodalMatrix  &rows,
           const SparseMatrix &matrix,
           Vector             &y,
           const Vector       &x);
} // namespace mortise
