// See interface_correction.h.
#include <mortise/solvers/interface_correction.h>

namespace mortise
{
  template <typename Number>
  InterfaceCorrection<Number>::InterfaceCorrection(
    const CouplingProduct<Number> &product,
    const DiagonalLifting         &lifting,
    const Epetra_Map              &multipliers)
    : product(product)
    , lifting(lifting)
    , jump(multipliers)
    , multiplier(jump)
  {
    product.initialize(trace);
    for (const unsigned int i : product.places())
      weights.push_back(
        static_cast<Number>(lifting.diagonal().local_element(i)));
  }

  template <typename Number>
  void
  InterfaceCorrection<Number>::apply() const
  {
    product.multiply(jump, trace);
    lifting.apply_inverse_schur(multiplier, jump);
    product.multiply_transposed(trace, multiplier);
  }

  template <typename Number>
  void
  InterfaceCorrection<Number>::project(LevelVector<Number> &x) const
  {
    const auto &places = product.places();
    for (unsigned int k = 0; k < places.size(); ++k)
      trace.local_element(k) = x.local_element(places[k]);
    apply();
    for (unsigned int k = 0; k < places.size(); ++k)
      x.local_element(places[k]) -= weights[k] * trace.local_element(k);
  }

  template <typename Number>
  void
  InterfaceCorrection<Number>::project_residual(LevelVector<Number> &r) const
  {
    const auto &places = product.places();
    for (unsigned int k = 0; k < places.size(); ++k)
      trace.local_element(k) = weights[k] * r.local_element(places[k]);
    apply();
    for (unsigned int k = 0; k < places.size(); ++k)
      r.local_element(places[k]) -= trace.local_element(k);
  }

  template class InterfaceCorrection<float>;
  template class InterfaceCorrection<double>;
} // namespace mortise
