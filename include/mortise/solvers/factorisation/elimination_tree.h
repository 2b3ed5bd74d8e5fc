// Elimination order and supernodes of a sparse Cholesky factorisation by nested
// dissection. Sources: Liu (1990), "The role of elimination trees in sparse
// factorisation"; METIS.
#pragma once

#include <deal.II/base/array_view.h>

#include <vector>

namespace mortise
{
  /// The graph of a symmetric matrix: columns of all rows, the diagonal
  /// included.
  struct MatrixGraph
  {
    std::vector<unsigned int>    begin;
    dealii::ArrayView<const int> columns;

    unsigned int
    size() const
    {
      return begin.size() - 1;
    }
  };

  /// Columns of the factor with the same rows below them, neighbours in the
  /// order of elimination.
  struct Supernode
  {
    unsigned int              first = 0, width = 0;
    std::vector<unsigned int> rows; ///< below its columns, ascending
    int                       parent = -1;
    std::vector<unsigned int> children;

    unsigned int
    height() const
    {
      return width + rows.size();
    }
  };

  struct EliminationTree
  {
    /// The same on all ranks that give the same graph.
    explicit EliminationTree(const MatrixGraph &graph);

    std::vector<Supernode> supernodes; ///< children in front of parents
    std::vector<unsigned int>
      permutation; ///< in the order, by row of the graph
  };

  constexpr int on_all_ranks = -1;

  /// The rank of each supernode: whole subtrees, balanced by entries of the
  /// factor, and on_all_ranks above them.
  std::vector<int>
  distribute_supernodes(const std::vector<Supernode> &supernodes, int n_ranks);
} // namespace mortise
