// Symmetric block Gauss-Seidel on overlapping blocks of rows, which may reach into other ranks;
// additive between the blocks of different ranks. It never solves exactly.
#pragma once

#include <Epetra_CrsMatrix.h>
#include <Epetra_Import.h>
#include <Epetra_Map.h>
#include <Epetra_Vector.h>

#include <deal.II/base/types.h>

#include <memory>
#include <vector>

namespace mortise
{
  /// M^{-1} = sum over ranks of R^T w G w R: R takes the rows in this rank's blocks, G is a sweep
  /// forward and one back over them, w^2 sums to one over the ranks. Symmetric and positive definite,
  /// since each G is.
  class BlockSmoother
  {
  public:
    /// @p blocks: global rows of each block; every row of the matrix is in at least one block of some
    /// rank. The matrix must stay alive. False, on this rank, when a block is not positive definite.
    /// Collective.
    bool
    initialize(const Epetra_CrsMatrix                                          &matrix,
               const std::vector<std::vector<dealii::types::global_dof_index>> &blocks);

    /// x = M^{-1} r. Collective.
    void
    vmult(Epetra_Vector &x, const Epetra_Vector &r) const;

  private:
    struct Block
    {
      std::vector<int>    rows;
      std::vector<double> inverse; ///< full, symmetric
    };

    void
    create_local_matrix(const Epetra_CrsMatrix                                          &matrix,
                        const std::vector<std::vector<dealii::types::global_dof_index>> &blocks);
    void
    relax(const Block &block, double *x, const double *r) const;
    void
    sweep(double *x, const double *r) const;

    std::vector<Block>                blocks;
    const Epetra_CrsMatrix           *matrix = nullptr; ///< what the sweeps run on
    std::unique_ptr<Epetra_CrsMatrix> local_matrix;     ///< with the rows of other ranks; none on one rank
    std::unique_ptr<Epetra_Map>       local_map;
    std::unique_ptr<Epetra_Import>    importer;
    std::unique_ptr<Epetra_Vector>    weight;
    mutable std::vector<double>       workspace;
    std::unique_ptr<Epetra_Vector>    x_local, r_local; ///< scratch of vmult()
  };
} // namespace mortise
