// See epetra_tools.h.
#include <EpetraExt_Transpose_RowMatrix.h>
#include <mortise/solvers/epetra_tools.h>

namespace mortise
{
  std::unique_ptr<Epetra_CrsMatrix>
  transpose(const Epetra_CrsMatrix &matrix, const Epetra_Map &rows)
  {
    EpetraExt::RowMatrix_Transpose transposer(const_cast<Epetra_Map *>(&rows));
    std::unique_ptr<Epetra_CrsMatrix> result(dynamic_cast<Epetra_CrsMatrix *>(
      &transposer(const_cast<Epetra_CrsMatrix &>(matrix))));
    transposer.ReleaseTranspose();
    return result;
  }

  std::vector<RowGroup>
  group_rows(const Epetra_CrsMatrix &matrix)
  {
    std::vector<RowGroup> groups;
    for (int i = 0; i < matrix.NumMyRows(); ++i)
      {
        const EpetraRow row(matrix, i);
        const auto      fits = [&](const EpetraRow &first) {
          return std::equal(row.columns,
                            row.columns + row.length,
                            first.columns,
                            first.columns + first.length);
        };
        if (groups.empty() || !fits(EpetraRow(matrix, groups.back().first)))
          groups.push_back({i, 0});
        ++groups.back().n_rows;
      }
    return groups;
  }
} // namespace mortise
