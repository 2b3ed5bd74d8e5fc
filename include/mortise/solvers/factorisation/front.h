// The dense frontal matrix of a supernode. Source: Liu (1992), "The
// multifrontal method for sparse matrix solution".
#pragma once

#include <mortise/solvers/factorisation/elimination_tree.h>

#include <vector>

namespace mortise
{
  /// The columns of a supernode with its rows below, and the update matrix;
  /// columnwise, the lower triangle. Both belong to the caller.
  template <typename Number>
  class Front
  {
  public:
    /// @p columns: zeros, @p stride apart; @p rest: the update matrix, resized.
    Front(const Supernode     &supernode,
          Number              *columns,
          int                  stride,
          std::vector<Number> &rest);

    /// The entries of column @p j by row, good from the diagonal on.
    Number *
    column(const int j)
    {
      return j < width ?
               columns + std::size_t(stride) * j :
               rest.data() + std::size_t(n_below) * (j - width) - width;
    }

    /// Compute the columns [L_11^{-1}; -L_21 L_11^{-1}], with which each half
    /// of a solve is one product, and the update matrix of the parent. False if
    /// they are not positive definite.
    bool
    eliminate();

  private:
    int                  width, n_below, stride;
    Number              *columns;
    std::vector<Number> &rest;
  };
} // namespace mortise
