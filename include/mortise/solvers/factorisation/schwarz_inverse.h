// The inverse of a matrix that is too large to be on one rank: corrections by
// factorisations of what the nodes of a rank and those that they couple with
// have among each other, of which a rank keeps those of its own nodes
// (restricted additive Schwarz). A rank never sees more. It suits matrices
// whose inverses decay from a node to its neighbours, as mass matrices' do.
// Sources: Demko, Moss, Smith (1984); Cai, Sarkis (1999).
#pragma once

#include <mortise/base/types.h>
#include <mortise/solvers/factorisation/nodal_matrix.h>
#include <mortise/solvers/factorisation/sparse_cholesky.h>

#include <functional>
#include <vector>

namespace mortise
{
  class SchwarzInverse
  {
  public:
    /// y = matrix x.
    using Product = std::function<void(Vector &y, const Vector &x)>;

    /// False, on every rank, when the matrix is not positive definite or
    /// corrections do not fall fast enough. @p product: with it, faster than with rows; it
    /// is kept. @p zero: a vector with the entries of the rows. Collective.
    bool
    initialize(const NodalMatrix &rows, Product product, const Vector &zero);

    /// x = matrix^{-1} b to six digits: a fixed number of corrections, so that
    /// it is linear. Collective.
    void
    solve(Vector &x, const Vector &b) const;

    /// The number of corrections.
    unsigned int
    n_corrections() const
    {
      return n_solves;
    }

  private:
    /// Until they are six digits smaller, for a vector without structure.
    bool
    count_solves();
    void
    solve_local(Vector &to, const Vector &from) const;

    std::vector<int>            entries; ///< as in NodalMatrix
    Product                     product;
    SparseCholesky<float>       local;   ///< owned nodes and neighbours
    mutable Vector              nodal;   ///< by these and component
    mutable std::vector<double> local_x; ///< likewise
    mutable Vector              r, z, q;
    unsigned int                n_solves = 0;
  };
} // namespace mortise
