// T, a cheap approximation of the inverse stiffness for forces B^T lambda on
// interfaces. The projector and the Schur complement B T B^T of the solvers are
// made of it.
#pragma once

#include <mortise/operators/block_system.h>
#include <mortise/solvers/factorisation/cholesky_inverse.h>
#include <mortise/solvers/factorisation/mumps_factorisation.h>
#include <mortise/solvers/factorisation/schwarz_inverse.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace mortise
{
  /// T symmetric, positive semi-definite and positive on the range of B^T, and
  /// C = B T B^T + S factorised, S the compliance of springs.
  class Lifting
  {
  public:
    /// @p system must stay alive.
    explicit Lifting(const BlockSystem &system)
      : system(system)
    {}

    virtual ~Lifting() = default;

    /// False when the multipliers are not independent of each other.
    bool
    is_valid() const
    {
      return valid;
    }

    /// How C is inverted; empty for what does in most scenes, a factorisation
    /// in single precision that all ranks share.
    std::string
    description() const;

    /// dst = T src. Collective.
    virtual void
    vmult(Vector &dst, const Vector &src) const = 0;

    /// y = C^{-1} jump, to four digits at least in the norm of C; both with the
    /// rows of B, those that are active: y is zero elsewhere. Collective.
    void
    apply_inverse_schur(Epetra_Vector &y, const Epetra_Vector &jump) const;

  protected:
    /// The rows of C, entries those of vectors on @p map; in single precision
    /// where that is accurate enough. @p product: with C, likewise; it is kept.
    /// @p max_gathered: the largest number of rows that all ranks may have, if
    /// they can do without. Collective.
    void
    factorise(NodalMatrix             schur,
              SchwarzInverse::Product product,
              const Epetra_Map       &map,
              std::size_t             max_gathered);

    /// C as a matrix, in double precision. Collective.
    void
    factorise(const Epetra_CrsMatrix &schur);

    const BlockSystem &system;

  private:
    void
    solve(Epetra_Vector &y, const Epetra_Vector &jump) const;

    /// (Entry, inverse of the diagonal) of multipliers that C couples with no
    /// other, unless Schwarz treats all.
    std::vector<std::pair<int, double>> lone;
    /// For the others one of them; the last for what no other can.
    std::unique_ptr<SchwarzInverse>          schwarz;
    std::unique_ptr<CholeskyInverse<double>> cholesky;
    MumpsFactorisation                       mumps;
    std::vector<int>               mumps_entries;    ///< as in NodalMatrix
    std::unique_ptr<Epetra_Vector> mumps_x, mumps_b; ///< by these
    bool                           uses_mumps = false;
    bool                           valid = false;
  };
} // namespace mortise
