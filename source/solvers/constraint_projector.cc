// See constraint_projector.h.
#include <mortise/solvers/constraint_projector.h>
#include <mortise/solvers/epetra_tools.h>

#include <limits>

namespace mortise
{
  ConstraintProjector::ConstraintProjector(const BlockSystem &system,
                                           const Lifting     &lifting)
    : system(system)
    , lifting(lifting)
    , jump(system.owned_multiplier, system.communicator)
    , multiplier(jump)
    , force(system.owned_displacement, system.communicator)
    , correction(force)
  {}

  void
  ConstraintProjector::project_residual(Vector &r, Vector &lambda) const
  {
    lifting.vmult(correction, r);
    system.coupling.vmult(jump, correction);
    Epetra_Vector y = epetra_view(multiplier);
    lifting.apply_inverse_schur(y, epetra_view(jump));
    lambda += multiplier;
    multiplier *= -1.;
    system.coupling.Tvmult_add(r, multiplier);
  }

  void
  ConstraintProjector::satisfy(Vector &u, const Vector &g) const
  {
    // C^{-1} may be in single precision
    double previous = std::numeric_limits<double>::infinity();
    for (unsigned int step = 0; step < 8; ++step)
      {
        system.coupling.vmult(jump, u);
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
    system.coupling.vmult(jump, u);
    if (g != nullptr)
      jump -= *g;
    Epetra_Vector y = epetra_view(multiplier);
    lifting.apply_inverse_schur(y, epetra_view(jump));
    system.coupling.Tvmult(force, multiplier);
    lifting.vmult(correction, force);
    u -= correction;
    return multiplier;
  }
} // namespace mortise
