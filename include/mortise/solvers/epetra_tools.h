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

  /// One integer per owned row, also known on the columns of the matrix.
  /// Collective.
  inline std::vector<int>
  on_columns(const Epetra_CrsMatrix &matrix, const std::vector<int> &owned)
  {
    Epetra_IntVector source(matrix.RowMap()), target(matrix.ColMap());
    std::copy(owned.begin(), owned.end(), source.Values());
    if (matrix.Importer() != nullptr)
      target.Import(source, *matrix.Importer(), Insert);
    else
      std::copy(owned.begin(), owned.end(), target.Values());
    return std::vector<int>(target.Values(),
                            target.Values() + target.MyLength());
  }

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

  /// The matrices whose sum is A = K + J; only K without an interface.
  inline std::vector<const Epetra_CrsMatrix *>
  summands_of_bulk(const BlockSystem &system)
  {
    std::vector<const Epetra_CrsMatrix *> result{
      &system.stiffness.trilinos_matrix()};
    if (system.owned_multiplier.size() > 0)
      result.push_back(&system.jump_penalty.trilinos_matrix());
    return result;
  }

  /// First owned displacement dof; 0 on a rank without any.
  inline dealii::types::global_dof_index
  first_displacement(const BlockSystem &system)
  {
    return system.owned_displacement.n_elements() > 0 ?
             system.owned_displacement.nth_index_in_set(0) :
             0;
  }
} // namespace mortise
