// See interface_correction.h.
#include <deal.II/base/mpi.h>

#include <mortise/solvers/multipliers/interface_correction.h>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Neighbours that follow together have less energy than each of them by
    /// itself: doc/measurements/tuning.md.
    constexpr double share_of_followers = 0.9;
  } // namespace

  template <typename Number>
  InterfaceCorrection<Number>::InterfaceCorrection(
    const BlockSystem             &system,
    const CouplingProduct<Number> &product,
    const Lifting                 &lifting)
    : system(system)
    , product(product)
    , lifting(lifting)
    , jump(system.owned_multiplier, system.communicator)
    , multiplier(jump)
    , carried(jump)
    , added(jump)
    , smoothed(product.indices().size())
  {
    product.initialize(trace);
    for (const unsigned int i : product.indices())
      weights.push_back(
        static_cast<Number>(lifting.diagonal().local_element(i)));
    some_lead =
      Utilities::MPI::max(system.nodal->leading_displacements().empty() ? 0 : 1,
                          system.communicator) == 1;
  }

  template <typename Number>
  void
  InterfaceCorrection<Number>::add_followers(
    LevelVector<Number> &diagonal) const
  {
    for (const auto &leading : system.nodal->leading_displacements())
      diagonal.local_element(leading.index) +=
        static_cast<Number>(share_of_followers * leading.followers);
  }

  template <typename Number>
  void
  InterfaceCorrection<Number>::project(LevelVector<Number> &x) const
  {
    const auto &indices = product.indices();
    for (unsigned int k = 0; k < indices.size(); ++k)
      trace.local_element(k) = x.local_element(indices[k]);
    product.multiply(jump, trace, CoupledNodes::all);
    if (has_springs())
      {
        system.spring_compliance.vmult(multiplier, carried);
        jump -= multiplier;
      }
    lifting.apply_inverse_schur(multiplier, jump);
    product.multiply_transposed(trace, multiplier, CoupledNodes::following);
    for (unsigned int k = 0; k < indices.size(); ++k)
      x.local_element(indices[k]) -= weights[k] * trace.local_element(k);
    if (has_springs())
      carried += multiplier;
  }

  template <typename Number>
  void
  InterfaceCorrection<Number>::project_residual(LevelVector<Number> &r) const
  {
    const auto &indices = product.indices();
    for (unsigned int k = 0; k < indices.size(); ++k)
      trace.local_element(k) = weights[k] * r.local_element(indices[k]);
    apply(CoupledNodes::following, CoupledNodes::all);
    for (unsigned int k = 0; k < indices.size(); ++k)
      r.local_element(indices[k]) -= trace.local_element(k);
  }

  template class InterfaceCorrection<float>;
  template class InterfaceCorrection<double>;
} // namespace mortise
