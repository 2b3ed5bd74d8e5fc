// The coarsest level: the system on the vertex functions, solved by algebraic
// multigrid (ML) with rigid body modes, or by a factorisation when it is small.
// It knows nothing of higher modes.
#pragma once

#include <Epetra_CrsMatrix.h>
#include <Epetra_Import.h>
#include <Epetra_Map.h>
#include <Epetra_Vector.h>
#include <mortise/operators/block_system.h>
#include <mortise/solvers/sparse_factorization.h>

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

    /// @p matrix: a matrix whose rows include the vertex dofs of @p system under their own numbers.
    /// Collective. False when the factorisation broke down.
    bool
    initialize(const BlockSystem &system, const Epetra_CrsMatrix &matrix);

    /// x = P A_c^{-1} P^T r, both on the rows of the matrix given; x is
    /// overwritten. Collective.
    void
    vmult(Epetra_Vector &x, const Epetra_Vector &r) const;

    std::string
    description() const;

  private:
    void
    extract(const BlockSystem &system, const Epetra_CrsMatrix &matrix);
    void
    compute_rigid_modes(const BlockSystem &system);

    std::vector<int>            rows; ///< of the matrix given, in coarse order
    std::unique_ptr<Epetra_Map> map;
    std::unique_ptr<Epetra_CrsMatrix>                    coarse;
    std::vector<double>                                  rigid_modes;
    std::unique_ptr<SparseFactorization>                 factorization;
    std::unique_ptr<ML_Epetra::MultiLevelPreconditioner> multigrid;
    std::unique_ptr<Epetra_Vector>                       r_c, x_c;
  };
} // namespace mortise
