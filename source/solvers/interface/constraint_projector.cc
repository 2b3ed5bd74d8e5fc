// See constraint_projector.h.
#include <mortise/solvers/epetra_tools.h>
#include <mortise/solvers/interface/constraint_projector.h>

#include <limits>

namespace mortise
{
  ConstraintProjector::ConstraintProjector(const BlockSystem  &system,
                                           const CouplingRows &rows,
                                           const Lifting      &lifting)
    : lifting(lifting)
    , product(system, rows)
    , jump(system.owned_multiplier, system.communicator)
    , multiplier(jump)
    , force(system.owned_displacement, system.communicator)
    , correction(force)
  {
    product.initialize(trace);
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
  ConstraintProjector::satisfy(Vector &u, const Vector &g) const
  {
    // C^{-1} may be in single precision
    double previous = std::numeric_limits<double>::infinity();
    for (unsigned int step = 0; step < 8; ++step)
      {
        apply(u);
        jump -= g;
        const double norm = jump.l2_norm();
        if (!(norm > 0. && norm < 0.1 * previous))
          break;
        previous = norm;
        project(u, &g);
      }
  }

  const Vector &
  ConstraintProjector::project(Vector &u, const Vector *g) const
  {
    apply(u);
    if (g != nullptr)
      jump -= *g;
    Epetra_Vector y = epetra_view(multiplier);
    lifting.apply_inverse_schur(y, epetra_view(jump));
    product.multiply_transposed(trace, y);
    const auto &indices = product.indices();
    for (unsigned int k = 0; k < indices.size(); ++k)
      force.begin()[indices[k]] = trace.local_element(k);
    lifting.vmult(correction, force);
    u -= correction;
    return multiplier;
  }
} // namespace mortise
