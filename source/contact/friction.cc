// See friction.h.
#include <mortise/contact/friction.h>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Of a trial traction over the bound: with less a node is held across its
    /// direction, since linear solvers cannot tell such stiff springs from
    /// ties.
    constexpr double least_excess = 1e-3;
  } // namespace

  Friction
  next_friction(const Friction      &now,
                const FrictionBound &bound,
                const FrictionPoint &at,
                const double         rounding)
  {
    const Tensor<1, 3> trial  = at.traction + at.c * at.slip;
    const double       size   = trial.norm();
    const bool         sticks = now.status == NodeStatus::stick;
    const double       limit =
      (sticks ? bound.at_rest(at.pressure) : bound.of(at.pressure)) + rounding;
    Friction next;
    // what slipped without a bound has no direction, and may stick at once
    if (sticks || now.bound == 0. ?
          size <= limit :
          at.c * (at.slip * now.direction) < -rounding)
      return next;
    next.status = NodeStatus::slip;
    next.bound  = bound.of(at.pressure);
    if (!(next.bound > 0. && size > 0.))
      {
        next.bound = 0.;
        next.error = at.traction.norm();
        return next;
      }
    next.direction      = trial / size;
    const double excess = (size - next.bound) / next.bound;
    next.compliance     = excess > least_excess ? excess / at.c : 0.;
    next.error          = (at.traction - next.bound * next.direction).norm();
    return next;
  }
} // namespace mortise
