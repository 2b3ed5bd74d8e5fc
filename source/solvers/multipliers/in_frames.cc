// The Schur complement of multipliers along normals, in_frames().
#include <mortise/solvers/multipliers/weighted_square.h>

namespace mortise
{
  RowsByNode
  in_frames(const RowsByNode &C, const SparseMatrix &frames)
  {
    using Index             = SparseMatrix::Index;
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
    std::vector<Index> columns;
    for (unsigned int k = 0; k < A.n_columns(); ++k)
      columns.push_back(A.global_column(k));
    const auto of_columns = of_rows.fetch(columns);

    std::vector<SparseMatrix::Entry> entries;
    for (unsigned int i = 0; i < A.n_rows(); ++i)
      {
        const auto row = A.row(i), frame = of_rows.row(i);
        for (unsigned int m = 0; m < frame.length; ++m)
          for (unsigned int k = 0; k < row.length; ++k)
            for (std::size_t e = of_columns.begin[row.columns[k]];
                 e < of_columns.begin[row.columns[k] + 1];
                 ++e)
              entries.push_back(
                {of_rows.global_column(frame.columns[m]),
                 of_columns.columns[e],
                 frame.values[m] * row.values[k] * of_columns.values[e]});
      }
    return rows_as_nodes(
      SparseMatrix(frames.rows(), frames.rows(), comm, entries));
  }
} // namespace mortise
