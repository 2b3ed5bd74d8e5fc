#include <EpetraExt_MatrixMatrix.h>
#include <mortise/solvers/diagonal_lifting.h>
#include <mortise/solvers/epetra_tools.h>

#include <cmath>

namespace mortise
{
  using namespace dealii;

  DiagonalLifting::DiagonalLifting(const BlockSystem &system)
    : weights(system.owned_displacement.n_elements())
  {
    for (unsigned int i = 0; i < weights.size(); ++i)
      weights[i] = 1. / system.nodal->diagonal().local_element(i);

    const auto      &coupling = system.coupling.trilinos_matrix();
    Epetra_CrsMatrix scaled(coupling);
    Epetra_Vector    root(coupling.DomainMap());
    for (int i = 0; i < root.MyLength(); ++i)
      root[i] = std::sqrt(weights[i]);
    scaled.RightScale(root);
    // the product with the transpose made takes a hundredth of the time of the
    // one that Epetra makes of the matrix itself
    const auto transposed = transpose(scaled, coupling.DomainMap());
    schur = std::make_unique<Epetra_CrsMatrix>(Copy, coupling.RowMap(), 0);
    EpetraExt::MatrixMatrix::Multiply(
      scaled, false, *transposed, false, *schur);
  }

  void
  DiagonalLifting::vmult(Vector &dst, const Vector &src) const
  {
    const double *from = src.begin();
    double       *to   = dst.begin();
    for (unsigned int i = 0; i < weights.size(); ++i)
      to[i] = weights[i] * from[i];
  }
} // namespace mortise
