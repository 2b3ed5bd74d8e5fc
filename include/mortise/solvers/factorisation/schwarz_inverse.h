// Restricted additive Schwarz iteration with overlap one: each rank factorises
// the submatrix of its nodes and their neighbours. It suits matrices whose
// inverses decay from a node to its neighbours, as those of mass matrices do.
// Sources: Demko, Moss, Smith (1984); Cai, Sarkis (1999).
#pragma once

#include <mortise/base/types.h>
#include <mortise/solvers/factorisation/rows_by_node.h>
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

    /// False on all ranks if the matrix is not positive definite or corrections
    /// do not decrease fast enough. @p product: a fast product with the matrix,
    /// kept. @p zero: a vector with the entries of the rows. Collective.
    bool
    initialize(const RowsByNode &rows, Product product, const Vector &zero);

    /// x = matrix^{-1} b to six digits, linear in b since the number of
    /// corrections is fixed. Collective.
    void
    solve(Vector &x, const Vector &b) const;

    /// The number of corrections.
    unsigned int
    n_corrections() const
    {
      return n_solves;
    }

  private:
    /// Count corrections until they are six digits smaller, for a pseudo-random
    /// vector.
    bool
    count_solves();
    void
    solve_local(Vector &to, const Vector &from) const;

    std::vector<int>            entries; ///< as in RowsByNode
    Product                     product;
    SparseCholesky<float>       local;   ///< owned nodes and neighbours
    mutable Vector              nodal;   ///< by these and component
    mutable std::vector<double> local_x; ///< likewise
    mutable Vector              r, z, q;
    unsigned int                n_solves = 0;
  };
} // namespace mortise
