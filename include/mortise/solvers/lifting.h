// How a multiplier moves displacements cheaply. Projector and Schur complement
// of the solvers are made of it. It never looks at K as a whole.
#pragma once

#include <mortise/operators/block_system.h>
#include <mortise/solvers/sparse_cholesky.h>
#include <mortise/solvers/sparse_factorization.h>

namespace mortise
{
  /// T symmetric, positive semi-definite and positive on the range of B^T, and
  /// C = B T B^T factorised.
  class Lifting
  {
  public:
    virtual ~Lifting() = default;

    /// False when the multipliers are not independent of each other.
    bool
    is_valid() const
    {
      return valid;
    }

    /// dst = T src. Collective.
    virtual void
    vmult(Vector &dst, const Vector &src) const = 0;

    /// y = C^{-1} jump, to five digits at least where single precision was
    /// allowed; both with the rows of B. Collective.
    void
    apply_inverse_schur(Epetra_Vector &y, const Epetra_Vector &jump) const
    {
      if (light)
        light->solve(y, jump);
      else if (exact)
        exact->solve(y, jump);
      else
        heavy.solve(y, jump);
    }

  protected:
    /// The rows of C, distributed as @p map; in single precision where that is
    /// accurate enough. Collective.
    void
    factorise(SparseRows schur, const Epetra_Map &map);

    /// C as a matrix, in double precision. Collective.
    void
    factorise(const Epetra_CrsMatrix &schur);

  private:
    /// The first that is accurate enough; the last for what is too large to be
    /// gathered.
    std::unique_ptr<SparseCholesky<float>>  light;
    std::unique_ptr<SparseCholesky<double>> exact;
    SparseFactorization                     heavy;
    bool                                    valid = false;
  };
} // namespace mortise
