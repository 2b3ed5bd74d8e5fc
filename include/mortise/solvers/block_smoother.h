// Symmetric block Gauss-Seidel on overlapping blocks of rows of one rank, additive between ranks.
// It never communicates after it is built.
#pragma once

#include <Epetra_CrsMatrix.h>

#include <vector>

namespace mortise
{
  /// Symmetric and positive definite on any number of ranks, since each rank's part is.
  class BlockSmoother
  {
  public:
    /// @p blocks: owned rows (local positions), each in at least one block. The matrix must stay
    /// alive. False when a block is not positive definite; not collective.
    bool
    initialize(const Epetra_CrsMatrix &matrix, const std::vector<std::vector<int>> &blocks);

    /// x = M^{-1} r: one sweep forward, one back, from x = 0.
    void
    vmult(double *x, const double *r) const;

    /// Rows of the largest block.
    unsigned int
    largest_block() const;

  private:
    struct Block
    {
      std::vector<int>    rows;
      std::vector<double> cholesky; ///< column major
    };
    void
    relax(const Block &block, double *x, const double *r) const;

    std::vector<Block>          blocks;
    const Epetra_CrsMatrix     *matrix = nullptr;
    mutable std::vector<double> workspace;
  };
} // namespace mortise
