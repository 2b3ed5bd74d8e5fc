#include <mortise/solvers/interface/diagonal_lifting.h>
#include <mortise/solvers/interface/weighted_square.h>

namespace mortise
{
  DiagonalLifting::DiagonalLifting(const BlockSystem            &system,
                                   const CouplingRows           &rows,
                                   const CouplingProduct<float> &product,
                                   const std::size_t             max_gathered)
    : weights(system.nodal->node_diagonal())
  {
    for (unsigned int i = 0; i < weights.locally_owned_size(); ++i)
      weights.local_element(i) = 1. / weights.local_element(i);
    for (const auto &leading : system.nodal->leading_displacements())
      weights.local_element(leading.index) = 0.;
    LevelVector<float> trace;
    product.initialize(trace);
    const auto multiply =
      [&product, trace, this](Epetra_Vector       &to,
                              const Epetra_Vector &from) mutable {
        product.multiply_transposed(trace, from);
        const auto &indices = product.indices();
        for (unsigned int k = 0; k < indices.size(); ++k)
          trace.local_element(k) *= weights.local_element(indices[k]);
        product.multiply(to, trace);
      };
    factorise(weighted_square(rows, weights),
              multiply,
              rows.matrix.RowMap(),
              max_gathered);
  }

  void
  DiagonalLifting::vmult(Vector &dst, const Vector &src) const
  {
    const double *from = src.begin();
    double       *to   = dst.begin();
    for (unsigned int i = 0; i < weights.locally_owned_size(); ++i)
      to[i] = weights.local_element(i) * from[i];
  }
} // namespace mortise
