// See constraint_projector.h.
#include <mortise/solvers/multipliers/constraint_projector.h>

#include <limits>

namespace mortise
{
  ConstraintProjector::ConstraintProjector(
    const BlockSystem                &system,
    const RowsByEntity               &rows,
    const ApproximateSchurComplement &schur)
    : system(system)
    , schur(schur)
    , product(system, rows)
    , jump(system.owned_multiplier, system.communicator)
    , multiplier(jump)
  {
    system.bulk->initialize(force);
    system.bulk->initialize(correction);
    product.initialize(coupled_values);
    find_springs();
  }

  void
  ConstraintProjector::find_springs()
  {
    ties.clear();
    springs.clear();
    for (unsigned int i = 0; i < jump.locally_owned_size(); ++i)
      {
        const bool is_spring =
          system.has_springs() && system.compliance().row(i).length > 0;
        (is_spring ? springs : ties).push_back(i);
      }
  }

  void
  ConstraintProjector::update_directions()
  {
    product.take_frames(system);
    find_springs();
  }

  void
  ConstraintProjector::remove_multipliers(Vector &r, Vector &lambda) const
  {
    schur.apply_inverse_diagonal(correction, r);
    apply(correction);
    schur.apply_inverse(multiplier, jump);
    for (const unsigned int i : springs)
      multiplier.local_element(i) = 0.;
    lambda += multiplier;
    product.multiply_transposed(coupled_values, multiplier);
    const auto &indices = product.indices();
    for (unsigned int k = 0; k < indices.size(); ++k)
      r.local_element(indices[k]) -= coupled_values.local_element(k);
  }

  void
  ConstraintProjector::satisfy(Vector &u, Vector &lambda, const Vector &g) const
  {
    // C^{-1} may be in single precision
    double previous = std::numeric_limits<double>::infinity();
    for (unsigned int step = 0; step < 8; ++step)
      {
        apply(u);
        jump -= g;
        system.subtract_spring_opening(jump, lambda);
        system.clear_inactive(jump);
        const double norm = jump.l2_norm();
        if (!(norm > 0. && norm < 0.1 * previous))
          break;
        previous = norm;
        step_to_constraint(u);
        clear_ties(multiplier);
        lambda += multiplier;
      }
  }

  const Vector &
  ConstraintProjector::project(Vector &u, const Vector *g) const
  {
    apply(u);
    if (g != nullptr)
      jump -= *g;
    step_to_constraint(u);
    return multiplier;
  }

  void
  ConstraintProjector::step_to_constraint(Vector &u) const
  {
    schur.apply_inverse(multiplier, jump);
    product.multiply_transposed(coupled_values, multiplier);
    const auto &indices = product.indices();
    for (unsigned int k = 0; k < indices.size(); ++k)
      force.local_element(indices[k]) = coupled_values.local_element(k);
    schur.apply_inverse_diagonal(correction, force);
    u -= correction;
  }
} // namespace mortise
