#include <mortise/solvers/interface/diagonal_lifting.h>
#include <mortise/solvers/interface/weighted_square.h>

#include <utility>

namespace mortise
{
  DiagonalLifting::DiagonalLifting(const BlockSystem            &system,
                                   const CouplingRows           &rows,
                                   const CouplingProduct<float> &product,
                                   const std::size_t             max_gathered)
    : Lifting(system)
    , product(product)
    , max_gathered(max_gathered)
    , weights(system.nodal->node_diagonal())
  {
    for (unsigned int i = 0; i < weights.locally_owned_size(); ++i)
      weights.local_element(i) = 1. / weights.local_element(i);
    for (const auto &leading : system.nodal->leading_displacements())
      weights.local_element(leading.index) = 0.;
    schur = weighted_square(rows, weights);
    if (system.coupling.has_frames())
      schur = in_frames(schur, system.coupling.frames());
    if (system.has_springs())
      add(schur, system.spring_compliance.trilinos_matrix());
    if (!system.active)
      factorise_active(std::move(schur));
    else
      update_active();
  }

  bool
  DiagonalLifting::update_active()
  {
    factorise_active(select(schur,
                            *system.active,
                            system.coupling.row_map().Comm()));
    return is_valid();
  }

  void
  DiagonalLifting::factorise_active(NodalMatrix active)
  {
    LevelVector<float> trace;
    product.initialize(trace);
    const Epetra_CrsMatrix *const springs =
      system.has_springs() ? &system.spring_compliance.trilinos_matrix() :
                             nullptr;
    const auto multiply = [trace, springs, this](
                            Epetra_Vector       &to,
                            const Epetra_Vector &from) mutable {
      product.multiply_transposed(trace, from);
      const auto &indices = product.indices();
      for (unsigned int k = 0; k < indices.size(); ++k)
        trace.local_element(k) *= weights.local_element(indices[k]);
      product.multiply(to, trace);
      if (springs)
        {
          Epetra_Vector opening(to);
          springs->Multiply(false, from, opening);
          to.Update(1., opening, 1.);
        }
      system.clear_inactive(to.Values());
    };
    factorise(std::move(active),
              multiply,
              system.coupling.row_map(),
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
