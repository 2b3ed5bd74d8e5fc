// Coulomb friction at a node of contact: whether it sticks or slips, and the
// linearised law there. Sees numbers at a node and no mesh.
//
// With the trial traction lambda_t + c s, the slip s of the slave against the
// master since the last step and any c > 0, the law |lambda_t| <= F, s = 0 or
// lambda_t = F s / |s| reads lambda_t = min(1, F / |lambda_t + c s|)
// (lambda_t + c s). Its generalised derivative: a node with a trial traction
// within the bound sticks, another has lambda_t = F d along the direction d of
// its trial traction and across it
//
//     s = compliance lambda_t, compliance = (|lambda_t + c s| - F) / (F c)
//
// Sources: Hueber, Stadler, Wohlmuth (2008); Gitterle, Popp, Gee, Wall (2010).
#pragma once

#include <deal.II/base/tensor.h>

namespace mortise
{
  enum class NodeStatus : unsigned char
  {
    open, ///< no traction
    slip, ///< held along the normal alone
    stick ///< held in all directions; without friction, closed
  };

  /// Bound F of the tangential traction for the pressure p: force per area.
  struct FrictionBound
  {
    double coefficient = 0.; ///< F = coefficient p: Coulomb
    double given       = 0.; ///< added to that: Tresca
    /// In place of the coefficient where a node sticks.
    double static_coefficient = 0.;

    double
    of(const double pressure) const
    {
      return given + coefficient * (pressure > 0. ? pressure : 0.);
    }

    double
    at_rest(const double pressure) const
    {
      return given + static_coefficient * (pressure > 0. ? pressure : 0.);
    }
  };

  /// Of an iterate, in the space of the multipliers of a node.
  struct FrictionPoint
  {
    dealii::Tensor<1, 3> traction; ///< lambda_t on the master, force per area
    dealii::Tensor<1, 3> slip;     ///< s, a length
    double               pressure = 0.;
    double               c        = 0.; ///< force per volume
  };

  /// Status of a closed node and the law that is linearised there.
  struct Friction
  {
    NodeStatus           status = NodeStatus::stick;
    dealii::Tensor<1, 3> direction;  ///< d; zero without a bound
    double               bound = 0.; ///< F, force per area; of nodes that slip
    double               compliance = 0.; ///< across d, a volume per force
    /// |lambda_t - F d|, by which the iterate violates the law of a node that
    /// slips; force per area.
    double error = 0.;
  };

  /// What follows from the iterate @p at with the law @p now. Tractions differ
  /// by @p rounding, force per area, if at all. A node that moves against its
  /// traction sticks first, so that it does not slip to and fro.
  Friction
  next_friction(const Friction      &now,
                const FrictionBound &bound,
                const FrictionPoint &at,
                double               rounding);
} // namespace mortise
