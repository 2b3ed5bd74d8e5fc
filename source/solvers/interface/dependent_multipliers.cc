#include <EpetraExt_MatrixMatrix.h>
#include <mortise/solvers/factorisation/mumps_factorisation.h>
#include <mortise/solvers/interface/dependent_multipliers.h>

#include <cmath>

namespace mortise
{
  std::vector<dealii::types::global_dof_index>
  find_dependent_multipliers(const CouplingMatrix &coupling,
                             const Epetra_Vector  &inverse_diagonal,
                             const Epetra_Vector  &scale,
                             const SparseMatrix   &compliance)
  {
    const auto root = [](const Epetra_Vector &square) {
      Epetra_Vector result(square);
      for (int i = 0; i < result.MyLength(); ++i)
        result[i] = std::sqrt(square[i]);
      return result;
    };
    Epetra_CrsMatrix B = coupling.expanded();
    B.LeftScale(root(scale));
    B.RightScale(root(inverse_diagonal));
    Epetra_CrsMatrix C(Copy, B.RowMap(), 0);
    EpetraExt::MatrixMatrix::Multiply(B, false, B, true, C);
    if (compliance.m() > 0)
      {
        Epetra_Vector diagonal(C.RowMap()), opening(diagonal);
        C.ExtractDiagonalCopy(diagonal);
        compliance.trilinos_matrix().ExtractDiagonalCopy(opening);
        diagonal.Multiply(1., scale, opening, 1.);
        C.ReplaceDiagonalValues(diagonal);
      }
    MumpsFactorisation factorisation;
    factorisation.initialize(C, MatrixKind::positive_semidefinite);
    return factorisation.null_rows();
  }
} // namespace mortise
