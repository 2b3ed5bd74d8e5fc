// Sparse factorisation (MUMPS) of a distributed matrix for repeated solves,
// without iterative refinement.
#pragma once

#include <mortise/base/sparse_matrix.h>

#include <memory>
#include <vector>

namespace mortise
{
  enum class MatrixKind
  {
    general,
    positive_definite,    ///< and symmetric: half the work and memory
    positive_semidefinite ///< and symmetric, with a diagonal of ones
  };

  class MumpsFactorisation
  {
  public:
    MumpsFactorisation();
    ~MumpsFactorisation();

    /// Factorise @p matrix, which is not kept. Ranks without rows take part.
    /// False if the factorisation breaks down or a positive definite matrix is
    /// not; throws std::bad_alloc on all ranks if memory runs out on one.
    /// Collective.
    bool
    initialize(const SparseMatrix &matrix, MatrixKind kind);

    /// x = matrix^{-1} b, both by owned row; false when the
    /// solve failed. Collective.
    bool
    solve(double *x, const double *b) const;

    /// Rows of a positive semidefinite matrix that depend on the others; the
    /// same on all ranks. Collective.
    std::vector<dealii::types::global_dof_index>
    null_rows() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation;
  };
} // namespace mortise
