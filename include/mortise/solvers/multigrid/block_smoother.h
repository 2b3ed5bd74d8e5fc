// Block Gauss-Seidel on overlapping blocks of rows, which may reach into other
// ranks; additive between the blocks of different ranks.
#pragma once

#include <deal.II/base/types.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Import.h>
#include <Epetra_Map.h>
#include <Epetra_Vector.h>

#include <memory>
#include <vector>

namespace mortise
{
  /// S = omega sum over ranks of R^T G R: R takes the rows in this rank's
  /// blocks, G is a sweep over them from zero. On one rank omega is 1, and I -
  /// S A contracts in the norm of A. The sum over ranks does where omega is
  /// below one over the largest number of them that share a row; more than that
  /// takes fewer iterations, until it fails: doc/tuning.md.
  class BlockSmoother
  {
  public:
    /// @p blocks: global rows of each block; every row of the matrix is in at least one block of some
    /// rank. The matrix must stay alive. False, on this rank, when a block is
    /// not positive definite. Collective.
    bool
    initialize(
      const Epetra_CrsMatrix                                          &matrix,
      const std::vector<std::vector<dealii::types::global_dof_index>> &blocks);

    enum class Sweep
    {
      forward,
      backward ///< the transpose
    };

    /// x = S r. Collective.
    void
    vmult(Epetra_Vector &x, const Epetra_Vector &r, Sweep direction) const;

    struct Block
    {
      std::vector<int>    rows;    ///< positions in map()
      std::vector<double> inverse; ///< full, symmetric
    };

    const std::vector<Block> &
    blocks() const
    {
      return patches;
    }

    /// Global numbers of the rows that this rank works on: the owned ones, then
    /// those of other ranks in its blocks.
    const Epetra_Map &
    map() const
    {
      return local_map ? *local_map : matrix->RowMap();
    }

    /// From the rows of the matrix to map(); null on one rank.
    const Epetra_Import *
    importer() const
    {
      return to_local.get();
    }

    /// x = sum over the blocks b in @p selected of all ranks of R_b^T A_b^{-1} R_b r. Collective.
    void
    solve_blocks(Epetra_Vector                   &x,
                 const Epetra_Vector             &r,
                 const std::vector<unsigned int> &selected) const;

    void
    create_local_matrix(
      const Epetra_CrsMatrix                                          &matrix,
      const std::vector<std::vector<dealii::types::global_dof_index>> &blocks);
    void
    find_damping();
    void
    relax(const Block &block, double *x, const double *r) const;
    /// x += A_b^{-1} times the right hand side of the block in the workspace.
    void
    add_solution(const Block &block, double *x) const;
    void
    sweep(double *x, const double *r, Sweep direction) const;

    double                  damping = 1.; ///< omega
    std::vector<Block>      patches;
    const Epetra_CrsMatrix *matrix = nullptr; ///< what the sweeps run on
    std::unique_ptr<Epetra_CrsMatrix>
      local_matrix; ///< with the rows of other ranks; none on one rank
    std::unique_ptr<Epetra_Map>    local_map;
    std::unique_ptr<Epetra_Import> to_local;
    mutable std::vector<double>    workspace;
    std::unique_ptr<Epetra_Vector> x_local, r_local; ///< scratch of vmult()
  };
} // namespace mortise
