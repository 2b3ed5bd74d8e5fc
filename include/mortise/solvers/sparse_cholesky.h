// A sparse Cholesky factorisation by dense blocks for the many solves of a
// preconditioner, several times faster in these than a general library. Its
// subtrees are dealt out to the ranks; what is above them, and the matrix while
// it is factorised, is on all.
// Sources: Duff, Reid (1983); Liu (1992), "The multifrontal method".
#pragma once

#include <deal.II/base/aligned_vector.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Vector.h>
#include <mortise/solvers/elimination_tree.h>

#include <memory>
#include <vector>

namespace mortise
{
  /// Owned rows of a matrix, those of a rank behind those of the rank before.
  struct SparseRows
  {
    std::vector<unsigned int> lengths;
    std::vector<int>          columns; ///< global
    std::vector<double>       values;
  };

  /// Computed in double precision, kept and applied in @p Number.
  template <typename Number>
  class SparseCholesky
  {
  public:
    /// Factorise the symmetric matrix of these rows. False, on every rank, when
    /// it is not positive definite. Collective.
    bool
    initialize(SparseRows rows, MPI_Comm comm);

    /// The same; rows must be numbered 0, 1, ... over the ranks.
    bool
    initialize(const Epetra_CrsMatrix &matrix);

    /// x = matrix^{-1} b, both with the rows of the matrix. Collective.
    void
    solve(Epetra_Vector &x, const Epetra_Vector &b) const;

  private:
    struct GatheredMatrix;

    void
    list_parts();
    bool
    factorise(const GatheredMatrix &matrix);
    void
    forward(unsigned int s) const;
    void
    backward(unsigned int s) const;

    MPI_Comm                  comm = MPI_COMM_NULL;
    int                       rank = 0, n_ranks = 1;
    std::vector<int>          counts, starts; ///< rows by rank
    std::vector<double>       scale;          ///< by owned row
    std::vector<unsigned int> place;          ///< of each row in the order
    std::vector<Supernode>    supernodes;
    std::vector<int>          owner;         ///< rank or on_all_ranks
    std::vector<unsigned int> own, common;   ///< supernodes
    std::vector<unsigned int> common_places; ///< of rows
    std::vector<int>          part_counts, part_starts; ///< rows of subtrees
    std::vector<unsigned int> part_place; ///< of these, rank by rank
    /// By supernode, see Front::panel().
    std::vector<dealii::AlignedVector<Number>> panels;
    mutable std::vector<Number> vector; ///< in the order of elimination
    mutable std::vector<Number> exchange;
    mutable dealii::AlignedVector<Number> workspace; ///< of one supernode
  };
} // namespace mortise
