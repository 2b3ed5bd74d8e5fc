// The Schur complement of multipliers in directions of their own, in_frames().
#include <mortise/solvers/multipliers/weighted_square.h>

namespace mortise
{
  RowsByNode
  in_frames(const RowsByNode        &C,
            const SparseMatrix      &frames,
            const std::vector<bool> &left_out)
  {
    const MPI_Comm      comm = frames.communicator();
    const SparseMatrix  A = as_matrix(C, comm), by_row = frames.transposed();
    std::vector<double> flags(left_out.begin(), left_out.end());
    if (!left_out.empty())
      flags = by_row.on_columns(flags.data());
    // R^T in the numbering of A
    SparseMatrix::CompressedRows rows;
    for (const int entry : C.entries)
      {
        const auto row = entry < 0 ? SparseMatrix::Row{0, nullptr, nullptr} :
                                     by_row.row(entry);
        for (unsigned int k = 0; k < row.length; ++k)
          if (left_out.empty() || flags[row.columns[k]] == 0.)
            {
              rows.columns.push_back(by_row.global_column(row.columns[k]));
              rows.values.push_back(row.values[k]);
            }
        rows.begin.push_back(rows.columns.size());
      }
    const SparseMatrix of_rows(A.rows(), frames.rows(), comm, std::move(rows));
    return rows_as_nodes(of_rows.transposed().times(A.times(of_rows)));
  }
} // namespace mortise
