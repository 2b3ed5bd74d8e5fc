// The dense matrix that a supernode of a factorisation is computed from.
// Source: Liu (1992), "The multifrontal method for sparse matrix solution".
#pragma once

#include <mortise/solvers/factorisation/elimination_tree.h>

#include <vector>

namespace mortise
{
  /// The columns of a supernode, with its rows below, and what they update;
  /// columnwise, the lower triangle. Both are kept by others.
  template <typename Number>
  class Front
  {
  public:
    /// @p columns: zeros, @p stride apart; @p rest becomes the square of the
    /// rows below.
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

    /// The columns become [L_11^{-1}; -L_21 L_11^{-1}], so that both halves of
    /// a solve with them are one product, the rest what remains for the parent.
    /// False when the columns are not positive definite.
    bool
    eliminate();

  private:
    int                  width, n_below, stride;
    Number              *columns;
    std::vector<Number> &rest;
  };
} // namespace mortise
