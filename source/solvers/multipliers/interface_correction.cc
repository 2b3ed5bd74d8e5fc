// See interface_correction.h.
#include <deal.II/base/mpi.h>

#include <mortise/solvers/multipliers/interface_correction.h>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Dependent neighbours together have less energy than each of them by
    /// itself: doc/measurements/tuning.md.
    constexpr double fraction_of_dependent = 0.9;
  } // namespace

  template <typename Number>
  InterfaceCorrection<Number>::InterfaceCorrection(
    const BlockSystem                &system,
    const CouplingProduct<Number>    &product,
    const ApproximateSchurComplement &schur)
    : system(system)
    , product(product)
    , schur(schur)
    , jump(system.owned_multiplier, system.communicator)
    , multiplier(jump)
    , carried(jump)
    , added(jump)
    , smoothed(product.indices().size())
  {
    product.initialize(coupled_values);
    for (const unsigned int i : product.indices())
      weights.push_back(
        static_cast<Number>(schur.inverse_diagonal().local_element(i)));
    any_independent =
      Utilities::MPI::max(system.bulk->independent_displacements().empty() ? 0 :
                                                                             1,
                          system.communicator) == 1;
  }

  template <typename Number>
  void
  InterfaceCorrection<Number>::add_dependent_stiffness(
    LevelVector<Number> &diagonal) const
  {
    for (const auto &independent : system.bulk->independent_displacements())
      diagonal.local_element(independent.index) += static_cast<Number>(
        fraction_of_dependent * independent.dependent_stiffness);
  }

  template <typename Number>
  void
  InterfaceCorrection<Number>::project(LevelVector<Number> &x) const
  {
    const auto &indices = product.indices();
    for (unsigned int k = 0; k < indices.size(); ++k)
      coupled_values.local_element(k) = x.local_element(indices[k]);
    product.multiply(jump, coupled_values, CoupledNodes::all);
    if (has_springs())
      {
        system.compliance().vmult(multiplier, carried);
        jump -= multiplier;
      }
    schur.apply_inverse(multiplier, jump);
    product.multiply_transposed(coupled_values,
                                multiplier,
                                CoupledNodes::dependent);
    for (unsigned int k = 0; k < indices.size(); ++k)
      x.local_element(indices[k]) -=
        weights[k] * coupled_values.local_element(k);
    if (has_springs())
      carried += multiplier;
  }

  template <typename Number>
  void
  InterfaceCorrection<Number>::project_residual(LevelVector<Number> &r) const
  {
    const auto &indices = product.indices();
    for (unsigned int k = 0; k < indices.size(); ++k)
      coupled_values.local_element(k) =
        weights[k] * r.local_element(indices[k]);
    apply(CoupledNodes::dependent, CoupledNodes::all);
    for (unsigned int k = 0; k < indices.size(); ++k)
      r.local_element(indices[k]) -= coupled_values.local_element(k);
  }

  template class InterfaceCorrection<float>;
  template class InterfaceCorrection<double>;
} // namespace mortise
