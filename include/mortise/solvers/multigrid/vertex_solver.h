// The coarsest level: the system on the vertex functions, solved by algebraic
// multigrid (ML) with rigid body modes, or by a factorisation when it is small.
// It knows nothing of higher modes.
#pragma once

#include <Epetra_CrsMatrix.h>
#include <Epetra_Import.h>
#include <Epetra_Map.h>
#include <Epetra_Vector.h>
#include <mortise/operators/block_system.h>
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
  /// Owned vertex functions of a matrix.
  struct VertexFunctions
  {
    /// Three rows per vertex, x, y, z consecutive, prescribed ones included.
    const std::vector<dealii::types::global_dof_index> &rows;
    const std::vector<dealii::Point<dim>>              &points; ///< vertices
  };

  class VertexSolver
  {
  public:
    VertexSolver();
    ~VertexSolver();

    /// @p matrix: its rows include those of @p vertices under their own numbers.
    /// @p allow_single: for what is itself in single precision. Where
    /// vertices were all that there was, saddle_point() took 17 iterations
    /// instead of 14. Collective.
    /// False when the factorisation broke down.
    bool
    initialize(const VertexFunctions  &vertices,
               const Epetra_CrsMatrix &matrix,
               bool                    allow_single);

    /// The same for a matrix whose rows are the vertices', numbered 0, 1, ...
    bool
    initialize(std::unique_ptr<Epetra_CrsMatrix>      matrix,
               const std::vector<dealii::Point<dim>> &points,
               bool                                   allow_single);

    /// x = P A_c^{-1} P^T r, both on the rows of the matrix given; x is
    /// overwritten. Collective.
    void
    vmult(Epetra_Vector &x, const Epetra_Vector &r) const;

    std::string
    description() const;

  private:
    void
    extract(const VertexFunctions &vertices, const Epetra_CrsMatrix &matrix);
    bool
    make_inverse(const std::vector<dealii::Point<dim>> &points,
                 bool                                   allow_single);
    void
    compute_rigid_modes(const std::vector<dealii::Point<dim>> &points);

    std::vector<int>            rows; ///< of the matrix given, in coarse order
    std::unique_ptr<Epetra_Map> map;
    std::unique_ptr<Epetra_CrsMatrix>                    coarse;
    std::vector<double>                                  rigid_modes;
    std::unique_ptr<CholeskyInverse<float>>              factorisation;
    std::unique_ptr<ML_Epetra::MultiLevelPreconditioner> multigrid;
    std::unique_ptr<Epetra_Vector>                       r_c, x_c;
  };
} // namespace mortise
