// Small helpers for Epetra matrices that several solvers share.
#pragma once

#include <Epetra_CrsMatrix.h>
#include <Epetra_IntVector.h>
#include <Epetra_MpiComm.h>
#include <mortise/operators/block_system.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace mortise
{
  inline MPI_Comm
  communicator(const Epetra_BlockMap &map)
  {
    return dynamic_cast<const Epetra_MpiComm &>(map.Comm()).Comm();
  }

  /// A view of one owned row of a matrix, columns in the numbering of its
  /// column map.
  struct EpetraRow
  {
    int     length  = 0;
    int    *columns = nullptr;
    double *values  = nullptr;

    EpetraRow(const Epetra_CrsMatrix &matrix, const int row)
    {
      matrix.ExtractMyRowView(row, length, values, columns);
    }
  };

  /// The vector as Epetra's solvers take it.
  inline Epetra_MultiVector &
  epetra(Vector &v)
  {
    return const_cast<Epetra_FEVector &>(v.trilinos_vector());
  }

  /// A view of it.
  inline Epetra_Vector
  epetra_view(Vector &v)
  {
    return Epetra_Vector(View, v.trilinos_partitioner(), v.begin());
  }

  /// The transposed matrix with its rows on @p rows. Collective.
  std::unique_ptr<Epetra_CrsMatrix>
  transpose(const Epetra_CrsMatrix &matrix, const Epetra_Map &rows);

  /// Neighbouring owned rows with the same columns, as those of one entity of
  /// the mesh are.
  struct RowGroup
  {
    int first = 0, n_rows = 0;
  };

  /// All owned rows in such groups.
  std::vector<RowGroup>
  group_rows(const Epetra_CrsMatrix &matrix);
} // namespace mortise
