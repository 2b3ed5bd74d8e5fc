// How a multiplier moves displacements where these are values at nodes: each
// node by itself. It never looks at levels below the finest.
#pragma once

#include <Epetra_CrsMatrix.h>
#include <Epetra_Vector.h>
#include <mortise/solvers/bulk_preconditioner.h>

#include <memory>

namespace mortise
{
  /// T = diag(K)^{-1} on the nodes of interfaces.
  class DiagonalLifting : public Lifting
  {
  public:
    /// Collective.
    explicit DiagonalLifting(const BlockSystem &system);

    const Epetra_CrsMatrix &
    schur_complement() const override
    {
      return *schur;
    }

    void
    vmult(Vector &dst, const Vector &src) const override;

  private:
    std::unique_ptr<Epetra_CrsMatrix> schur;
    std::vector<double>               weights; ///< owned displacements
  };
} // namespace mortise
