// Exact elimination of the cell interiors from A = K + J: what remains is the Schur complement S on
// vertices, edges and faces, of the same sparsity. It never approximates and never solves with S.
#pragma once

#include <mortise/operators/block_system.h>
#include <mortise/solvers/entity_graph.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Vector.h>

#include <memory>
#include <vector>

namespace mortise
{
  /// With interior dofs i and the others b,
  ///
  ///     A^{-1} = [ I  -X ] [ A_ii^{-1}      ] [  I    0 ]      X = A_ii^{-1} A_ib
  ///              [ 0   I ] [         S^{-1} ] [ -X^T  I ]      S = A_bb - A_bi X.
  class InteriorCondensation
  {
  public:
    /// Collective.
    InteriorCondensation(const BlockSystem &system, const EntityGraph &graph);

    /// S, on the map of the dofs that remain (their numbers are those of the system).
    const Epetra_CrsMatrix &
    schur_complement() const
    {
      return *schur;
    }

    /// False when an interior block was not positive definite on any rank: nothing can be solved.
    bool
    is_valid() const
    {
      return valid;
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
      std::vector<int>    neighbors; ///< columns of S, sorted
      std::vector<double> cholesky;  ///< of A_ii, column major
      std::vector<double> coupling;  ///< A_ib, column major; only during the elimination
      std::vector<double> extension; ///< X, column major
    };

    /// A row of a correction of S for the rank that owns it: columns[0] is the row.
    struct RemoteRow
    {
      std::vector<int>    columns;
      std::vector<double> values;

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &columns &values;
      }
    };

    void
    build_base(const BlockSystem &system);
    void
    eliminate(const BlockSystem &system, const EntityGraph &graph);
    Interior
    extract_interior(const BlockSystem &system, const unsigned int block) const;
    void
    add_to_row(const int row, const std::vector<int> &columns, const double *values);

    std::vector<int>                  position;       ///< row of S of each owned dof; -1 for interior dofs
    std::vector<int>                  remaining_dofs; ///< position of each row of S
    std::vector<Interior>             interiors;
    std::unique_ptr<Epetra_CrsMatrix> schur;
    std::unique_ptr<Epetra_Vector>    ghosted; ///< on the column map of S
    bool                              valid = true;
  };
} // namespace mortise
