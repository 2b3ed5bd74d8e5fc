// See constraint_projector.h.
#include <mortise/solvers/constraint_projector.h>
#include <mortise/solvers/epetra_tools.h>

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
  {
    valid = inner.initialize(lifting.schur_complement(),
                             MatrixKind::positive_definite);
  }

  void
  ConstraintProjector::project_residual(Vector &r, Vector &lambda) const
  {
    lifting.vmult(correction, r);
    system.coupling.vmult(jump, correction);
    Epetra_Vector y = epetra_view(multiplier);
    inner.solve(y, epetra_view(jump));
    lambda += multiplier;
    multiplier *= -1.;
    system.coupling.Tvmult_add(r, multiplier);
  }

  const Vector &
  ConstraintProjector::project(Vector &u, const Vector *g) const
  {
    system.coupling.vmult(jump, u);
    if (g != nullptr)
      jump -= *g;
    Epetra_Vector y = epetra_view(multiplier);
    inner.solve(y, epetra_view(jump));
    system.coupling.Tvmult(force, multiplier);
    lifting.vmult(correction, force);
    u -= correction;
    return multiplier;
  }
} // namespace mortise
