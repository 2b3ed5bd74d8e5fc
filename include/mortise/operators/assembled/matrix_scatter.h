// Adds the matrices of cells to the matrix of the scene.
#pragma once

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/full_matrix.h>

#include <mortise/base/types.h>

#include <vector>

namespace mortise
{
  /// The same sums as AffineConstraints::distribute_local_to_global() of a
  /// matrix, to rounding. Where no dof of a cell depends on others and a row is owned, the
  /// entries are added in place: the dofs of a vertex, line or face are
  /// consecutive in the cell and in each row, and the rows of one entity have
  /// the same columns in the same places, so almost nothing is searched for.
  class MatrixScatter
  {
  public:
    /// Both are kept by reference; @p matrix has its pattern.
    MatrixScatter(const dealii::AffineConstraints<double> &constraints,
                  SparseMatrix                            &matrix);

    /// Add the leading rows and columns of a symmetric @p cell_matrix, as many as there are
    /// @p dofs. Rows of constrained dofs get a positive diagonal.
    void
    add(const dealii::FullMatrix<double>                   &cell_matrix,
        const std::vector<dealii::types::global_dof_index> &dofs);

    /// Add @p value to the diagonal of @p dof, owned.
    void
    add_diagonal(dealii::types::global_dof_index dof, double value);

  private:
    using Index = dealii::types::global_dof_index;

    /// Columns that are consecutive in the cell and in the matrix.
    struct Run
    {
      unsigned int first, size;
      int          column;   ///< local to the rank
      int          position; ///< in the last row
    };

    void
    find_runs(const std::vector<Index> &dofs);

    void
    add_row(Index row, const double *values, const std::vector<Index> &dofs);

    const dealii::AffineConstraints<double> &constraints;
    SparseMatrix                            &matrix;

    std::vector<char> constrained; ///< of the dofs of the cell
    std::vector<Run>  runs;
  };
} // namespace mortise
