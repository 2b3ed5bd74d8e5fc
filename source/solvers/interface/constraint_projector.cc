// See constraint_projector.h.
#include <mortise/solvers/epetra_tools.h>
#include <mortise/solvers/interface/constraint_projector.h>

#include <limits>

namespace mortise
{
  ConstraintProjector::ConstraintProjector(const BlockSystem  &system,
                                           const CouplingRows &rows,
                                           const Lifting      &lifting)
    : system(system)
    , lifting(lifting)
    , product(system, rows)
    , jump(system.owned_multiplier, system.communicator)
    , multiplier(jump)
    , force(system.owned_displacement, system.communicator)
    , correction(force)
  {
    product.initialize(trace);
    for (unsigned int i = 0; i < jump.locally_owned_size(); ++i)
      {
        const bool is_spring =
          system.has_springs() &&
          EpetraRow(system.spring_compliance.trilinos_matrix(),
                    static_cast<int>(i))
              .length > 0;
        (is_spring ? springs : ties).push_back(i);
      }
  }

  void
  ConstraintProjector::clear_springs(Vector &lambda) const
  {
    for (const unsigned int i : springs)
      lambda.begin()[i] = 0.;
  }

  void
  ConstraintProjector::clear_ties(Vector &lambda) const
  {
    for (const unsigned int i : ties)
      lambda.begin()[i] = 0.;
  }

  void
  ConstraintProjector::apply(const Vector &u) const
  {
    const auto &indices = product.indices();
    for (unsigned int k = 0; k < indices.size(); ++k)
      trace.local_element(k) = u.begin()[indices[k]];
    Epetra_Vector b = epetra_view(jump);
    product.multiply(b, trace);
  }

  void
  ConstraintProjector::project_residual(Vector &r, Vector &lambda) const
  {
    lifting.vmult(correction, r);
    apply(correction);
    Epetra_Vector y = epetra_view(multiplier);
    lifting.apply_inverse_schur(y, epetra_view(jump));
    lambda += multiplier;
    product.multiply_transposed(trace, y);
    const auto &indices = product.indices();
    for (unsigned int k = 0; k < indices.size(); ++k)
      r.begin()[indices[k]] -= trace.local_element(k);
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
        system.clear_inactive(jump.begin());
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
    Epetra_Vector y = epetra_view(multiplier);
    lifting.apply_inverse_schur(y, epetra_view(jump));
    product.multiply_transposed(trace, y);
    const auto &indices = product.indices();
    for (unsigned int k = 0; k < indices.size(); ++k)
      force.begin()[indices[k]] = trace.local_element(k);
    lifting.vmult(correction, force);
    u -= correction;
  }
} // namespace mortise
