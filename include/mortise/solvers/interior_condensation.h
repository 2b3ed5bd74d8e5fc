// Exact elimination of the cell interiors from A = K + J: what remains is the Schur complement S on
// vertices, edges and faces, of the same sparsity. It never approximates and never solves with S.
#pragma once

#include <mortise/operators/block_system.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Import.h>
#include <Epetra_Map.h>
#include <Epetra_Vector.h>

#include <memory>
#include <vector>

namespace mortise
{
  /// With interior dofs i and the others b,
  ///
  ///     A^{-1} = [ I  -X ] [ A_ii^{-1}      ] [  I    0 ]      X = A_ii^{-1} A_ib
  ///              [ 0   I ] [         S^{-1} ] [ -X^T  I ]      S = A_bb - A_bi X.
  ///
  /// A block of dofs is interior when all its neighbours are neighbours of each other, so that
  /// eliminating it fills in nothing; this is found in the graph of the matrix.
  class InteriorCondensation
  {
  public:
    /// Collective.
    explicit InteriorCondensation(const BlockSystem &system);

    /// S, on the map of the dofs that remain (their numbers are those of the system).
    const Epetra_CrsMatrix &
    schur_complement() const
    {
      return *schur;
    }

    /// Positions in the owned range of the system of the dofs that remain, in the order of S.
    const std::vector<int> &
    remaining() const
    {
      return remaining_dofs;
    }

    /// Blocks of owned rows of S (positions in S), one for each mesh entity that remains.
    const std::vector<std::vector<int>> &
    remaining_blocks() const
    {
      return blocks_of_schur;
    }

    std::size_t
    n_eliminated_blocks() const
    {
      return interiors.size();
    }

    /// r_b := (r - X^T r_i)_b. @p r has the owned range of the system. Collective.
    void
    restrict_residual(Epetra_Vector &r_b, const double *r) const;

    /// x := (A_ii^{-1} r_i - X x_b, x_b). Collective.
    void
    extend_solution(double *x, const Epetra_Vector &x_b, const double *r) const;

  private:
    struct Interior
    {
      std::vector<int>    dofs;      ///< positions in the owned range
      std::vector<int>    neighbors; ///< positions in the ghosted vector of remaining dofs
      std::vector<double> cholesky;  ///< of A_ii, column major
      std::vector<double> extension; ///< X, one row of the neighbours' length per dof
    };

    void
    find_interiors(const BlockSystem &system);
    void
    build_base(const BlockSystem &system);
    void
    eliminate(const BlockSystem &system);

    std::vector<bool>                 block_is_interior;
    std::vector<std::vector<int>> stars;
    std::vector<int>                  remaining_dofs;
    std::vector<std::vector<int>>     blocks_of_schur;
    std::vector<Interior>             interiors;
    std::unique_ptr<Epetra_CrsMatrix> schur;
    std::unique_ptr<Epetra_Vector>    ghosted; ///< on the column map of S
  };
} // namespace mortise
