// See interface_correction.h.
#include <mortise/solvers/interface_correction.h>

namespace mortise
{
  template <typename Number>
  InterfaceCorrection<Number>::InterfaceCorrection(
    const BlockSystem     &system,
    const DiagonalLifting &lifting)
    : lifting(lifting)
    , product(system)
    , jump(system.coupling.trilinos_matrix().RowMap())
    , multiplier(jump)
  {
    product.initialize(values);
    for (const unsigned int i : product.places())
      weights.push_back(
        static_cast<Number>(lifting.diagonal().local_element(i)));
  }

  template <typename Number>
  void
  InterfaceCorrection<Number>::apply() const
  {
    product.multiply(jump, values);
    lifting.apply_inverse_schur(multiplier, jump);
    product.multiply_transposed(values, multiplier);
  }

  template <typename Number>
  void
  InterfaceCorrection<Number>::project(LevelVector<Number> &x) const
  {
    const auto &places = product.places();
    for (const unsigned int i : places)
      values.local_element(i) = x.local_element(i);
    apply();
    for (unsigned int k = 0; k < places.size(); ++k)
      x.local_element(places[k]) -=
        weights[k] * values.local_element(places[k]);
  }

  template <typename Number>
  void
  InterfaceCorrection<Number>::project_residual(LevelVector<Number> &r) const
  {
    const auto &places = product.places();
    for (unsigned int k = 0; k < places.size(); ++k)
      values.local_element(places[k]) = weights[k] * r.local_element(places[k]);
    apply();
    for (const unsigned int i : places)
      r.local_element(i) -= values.local_element(i);
  }

  template class InterfaceCorrection<float>;
  template class InterfaceCorrection<double>;
} // namespace mortise
