// A sparse factorisation (MUMPS) of a distributed matrix, kept for repeated
// solves. It never refines and never checks how good a solution is.
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

    /// Factorise @p matrix; it is not referred to afterwards. Ranks without
    /// rows take part.
    /// False when the factorisation broke down, or when a matrix that was to be
    /// positive definite is not; throws std::bad_alloc on every rank when
    /// memory ran out on one. Collective.
    bool
    initialize(const SparseMatrix &matrix, MatrixKind kind);

    /// x = matrix^{-1} b, both by owned row; false when the
    /// solve failed. Collective.
    bool
    solve(double *x, const double *b) const;

    /// Rows of a positive semidefinite matrix that depend on the others, by
    /// their numbers; the same on all ranks. Collective.
    std::vector<dealii::types::global_dof_index>
    null_rows() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation;
  };
} // namespace mortise
