// The Schur complement of multipliers along normals, in_frames().
#include <mortise/solvers/multipliers/weighted_square.h>

namespace mortise
{
  RowsByNode
  in_frames(const RowsByNode &C, const SparseMatrix &frames)
  {
    const MPI_Comm     comm = frames.communicator();
    const SparseMatrix A = as_matrix(C, comm), by_row = frames.transposed();
    // R^T in the numbering of A
    SparseMatrix::CompressedRows rows;
    for (const int entry : C.entries)
      {
        const auto row = entry < 0 ? SparseMatrix::Row{0, nullptr, nullptr} :
                                     by_row.row(entry);
        for (unsigned int k = 0; k < row.length; ++k)
          rows.columns.push_back(by_row.global_column(row.columns[k]));
        rows.values.insert(rows.values.end(),
                           row.values,
                           row.values + row.length);
        rows.begin.push_back(rows.columns.size());
      }
    const SparseMatrix of_rows(A.rows(), frames.rows(), comm, std::move(rows));
    return rows_as_nodes(of_rows.transposed().times(A.times(of_rows)));
  }
} // namespace mortise
