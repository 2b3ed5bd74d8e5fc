// The coarsest level: the system on the vertex functions, solved by algebraic
// multigrid (ML) with rigid body modes, or by a factorisation when it is small.
// It knows nothing of higher modes.
#pragma once

#include <Epetra_CrsMatrix.h>
#include <Epetra_Vector.h>
#include <mortise/base/types.h>
#include <mortise/solvers/factorisation/cholesky_inverse.h>

#include <memory>
#include <string>
#include <vector>

namespace ML_Epetra
{
  class MultiLevelPreconditioner;
}

namespace mortise
{
  class VertexSolver
  {
  public:
    VertexSolver();
    ~VertexSolver();

    /// @p matrix: three rows for each of the owned @p points, x, y, z, prescribed ones included.
    /// @p allow_single: for what is itself in single precision. Collective.
    /// False when the factorisation broke down.
    bool
    initialize(std::unique_ptr<Epetra_CrsMatrix>      matrix,
               const std::vector<dealii::Point<dim>> &points,
               bool                                   allow_single);

    /// x = A^{-1} r, approximately; x is overwritten. Collective.
    void
    vmult(Epetra_Vector &x, const Epetra_Vector &r) const;

    std::string
    description() const;

  private:
    void
    compute_rigid_modes(const std::vector<dealii::Point<dim>> &points);

    std::unique_ptr<Epetra_CrsMatrix>                    coarse;
    std::vector<double>                                  rigid_modes;
    std::unique_ptr<CholeskyInverse<float>>              factorisation;
    std::unique_ptr<ML_Epetra::MultiLevelPreconditioner> multigrid;
  };
} // namespace mortise
