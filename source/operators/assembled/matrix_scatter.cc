#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>
#include <mortise/operators/assembled/matrix_scatter.h>

#include <algorithm>
#include <cmath>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using EpetraIndex = TrilinosWrappers::types::int_type;

    /// Index of @p column in the ascending @p columns of a row.
    int
    find(const int *columns, const int n, const int column)
    {
      const int *found = std::lower_bound(columns, columns + n, column);
      AssertThrow(found != columns + n && *found == column,
                  ExcMessage("a coupling is missing in the sparsity pattern"));
      return static_cast<int>(found - columns);
    }
  } // namespace

  MatrixScatter::MatrixScatter(const AffineConstraints<double> &constraints,
                               SparseMatrix                    &matrix)
    : constraints(constraints)
    , matrix(matrix)
  {
    Assert(matrix.trilinos_matrix().Filled(), ExcInternalError());
  }

  void
  MatrixScatter::find_runs(const std::vector<Index> &dofs)
  {
    const auto &columns = matrix.trilinos_matrix().ColMap();
    runs.clear();
    for (unsigned int i = 0; i < dofs.size(); ++i)
      if (!constrained[i])
        {
          const int column = columns.LID(static_cast<EpetraIndex>(dofs[i]));
          // -1: in no owned row
          if (column >= 0 && !runs.empty() && runs.back().column >= 0 &&
              runs.back().first + runs.back().size == i &&
              runs.back().column + static_cast<int>(runs.back().size) == column)
            ++runs.back().size;
          else
            runs.push_back({i, 1, column, 0});
        }
  }

  void
  MatrixScatter::add_row(const Index               row,
                         const double             *values,
                         const std::vector<Index> &dofs)
  {
    const auto &epetra = matrix.trilinos_matrix();
    const int   own    = epetra.RowMap().LID(static_cast<EpetraIndex>(row));
    if (own < 0)
      {
        // another rank's: sent there when the matrix is compressed
        for (const Run &run : runs)
          matrix.add(
            row, run.size, &dofs[run.first], values + run.first, false);
        return;
      }
    int     n       = 0;
    int    *columns = nullptr;
    double *entries = nullptr;
    epetra.ExtractMyRowView(own, n, entries, columns);
    for (Run &run : runs)
      {
        const int last = static_cast<int>(run.size) - 1;
        int       at   = run.position;
        if (at + last >= n || columns[at] != run.column)
          at = run.position = find(columns, n, run.column);
        Assert(at + last < n && columns[at + last] == run.column + last,
               ExcInternalError());
        for (unsigned int k = 0; k < run.size; ++k)
          entries[at + k] += values[run.first + k];
      }
  }

  void
  MatrixScatter::add_diagonal(const Index dof, const double value)
  {
    constrained.assign(1, false);
    const std::vector<Index> dofs(1, dof);
    find_runs(dofs);
    add_row(dof, &value, dofs);
  }

  void
  MatrixScatter::add(const FullMatrix<double> &cell_matrix,
                     const std::vector<Index> &dofs)
  {
    const unsigned int n = dofs.size();
    constrained.assign(n, false);
    for (unsigned int i = 0; i < n; ++i)
      if (constraints.is_constrained(dofs[i]))
        {
          constrained[i] = true;
          if (!constraints.get_constraint_entries(dofs[i])->empty())
            {
              FullMatrix<double> leading(n, n);
              leading.fill(cell_matrix);
              constraints.distribute_local_to_global(leading, dofs, matrix);
              return;
            }
        }
    find_runs(dofs);
    for (unsigned int i = 0; i < n; ++i)
      if (!constrained[i])
        add_row(dofs[i], &cell_matrix(i, 0), dofs);
    for (unsigned int i = 0; i < n; ++i)
      if (constrained[i])
        matrix.add(dofs[i], dofs[i], std::abs(cell_matrix(i, i)));
  }
} // namespace mortise
