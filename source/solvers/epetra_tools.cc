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
} // namespace mortise
