// Cholesky factorisation for a preconditioner, in single precision if that is
// accurate enough.
#pragma once

#include <mortise/solvers/factorisation/sparse_cholesky.h>

#include <functional>
#include <memory>

namespace mortise
{
  /// @p Work: precision in which the factors in single precision are computed.
  template <typename Work>
  class CholeskyInverse
  {
  public:
    /// y = matrix x.
    using Product = std::function<void(Vector &y, const Vector &x)>;

    /// @p rows, @p product: the matrix, the latter in double precision.
    /// @p zero: a vector with the entries of the rows. False on all ranks if
    /// the matrix is not positive definite. Collective.
    bool
    initialize(const RowsByNode &rows,
               const Product    &product,
               const Vector     &zero,
               bool              allow_single);

    /// x = matrix^{-1} b, to four digits at least in the norm of the matrix.
    /// Collective.
    void
    solve(Vector &x, const Vector &b) const
    {
      if (single_precision)
        single_precision->solve(x.begin(), b.begin());
      else
        double_precision->solve(x.begin(), b.begin());
    }

    bool
    is_single() const
    {
      return single_precision != nullptr;
    }

  private:
    std::unique_ptr<SparseCholesky<float, Work>> single_precision;
    std::unique_ptr<SparseCholesky<double>>      double_precision;
  };
} // namespace mortise
