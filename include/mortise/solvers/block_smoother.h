// Symmetric block Gauss-Seidel on the mesh entities of one rank, additive between ranks. It never
// communicates after it is built.
#pragma once

#include <Epetra_CrsMatrix.h>

#include <vector>

namespace mortise
{
  /// Symmetric and positive definite on any number of ranks, since each rank's part is.
  class BlockSmoother
  {
  public:
    /// @p blocks: owned rows (local positions), each in exactly one block. The matrix must stay alive.
    void
    initialize(const Epetra_CrsMatrix &matrix, const std::vector<std::vector<int>> &blocks);

    /// x = M^{-1} r: one sweep forward, one back, from x = 0.
    void
    vmult(double *x, const double *r) const;

  private:
    struct Block
    {
      std::vector<int>    rows;
      std::vector<double> cholesky; ///< column major
    };
    void
    relax(const Block &block, double *x, const double *r) const;

    std::vector<Block>      blocks;
    const Epetra_CrsMatrix *matrix = nullptr;
  };
} // namespace mortise
