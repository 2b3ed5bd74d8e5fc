// Constitutive law of an interface: its traction lambda as a function of the
// jump of the displacement.
#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <mortise/contact/friction.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace mortise
{
  enum class Law : unsigned char
  {
    tie,     ///< the jump of the displacement is zero
    slide,   ///< its component along the normal is zero
    contact, ///< gap >= 0, pressure >= 0, pressure gap = 0; Coulomb friction
    tresca,  ///< the same with a given bound of the tangential traction
    spring   ///< traction = K times the jump
  };

  /// Names in parameter files, in the order of Law.
  const std::vector<std::string> &
  interface_law_names();

  inline const std::string &
  name_of(Law law)
  {
    return interface_law_names()[static_cast<unsigned int>(law)];
  }

  /// Is it contact, whose multipliers satisfy an inequality?
  inline bool
  is_one_sided(Law law)
  {
    return law == Law::contact || law == Law::tresca;
  }

  /// Components of the jump that have a multiplier.
  enum class ConstrainedDirections : unsigned char
  {
    all,
    normal ///< of the slave
  };

  /// Stiffness of a thin layer, traction over jump, along its normal and
  /// tangentially; force per volume. Infinite where the jump is zero.
  struct InterfaceStiffness
  {
    double normal     = std::numeric_limits<double>::infinity();
    double tangential = std::numeric_limits<double>::infinity();
  };

  /// State of both sides of an interface at a point of the slave.
  struct InterfacePoint
  {
    dealii::Point<3>     position;
    dealii::Tensor<1, 3> normal;      ///< of the slave: outward, of unit length
    dealii::Tensor<1, 3> jump;        ///< u_master - u_slave, a length
    dealii::Tensor<1, 3> mesh_gap;    ///< X_master - X_slave, a length
    double               offset = 0.; ///< gap in addition to the mesh gap
    dealii::Tensor<1, 3> traction;    ///< lambda, on the master: force per area
    FrictionBound        friction;    ///< zero without
  };

  struct InterfaceLaw
  {
    Law                   law         = Law::tie;
    ConstrainedDirections constrained = ConstrainedDirections::all;
    /// Does the gap between the meshes count? If not, the surfaces are taken as
    /// coinciding.
    bool has_mesh_gap = false;
    /// Stiffness K of a spring at a point of the slave; null for other laws.
    std::function<InterfaceStiffness(const dealii::Point<3> &)> stiffness;

    /// Do multipliers satisfy an inequality, with an active set?
    bool
    is_one_sided() const
    {
      return mortise::is_one_sided(law);
    }

    /// Have its tangential tractions multipliers of their own?
    bool
    has_friction() const
    {
      return is_one_sided() && constrained == ConstrainedDirections::all;
    }

    /// Has the constraint a compliance K^{-1}?
    bool
    is_compliant() const
    {
      return law == Law::spring;
    }

    /// g = n . (jump + mesh gap) + offset, a length; negative on penetration.
    double
    gap(const InterfacePoint &point) const;

    /// Is the point active: pressure - c g > 0 with the complementarity
    /// parameter @p c, force per volume?
    bool
    is_active(const InterfacePoint &point, double c) const
    {
      return point.traction * point.normal > c * gap(point);
    }

    /// Does the point stick: is its trial traction (see friction.h) within the
    /// bound, the jump being the slip? True without friction.
    bool
    sticks(const InterfacePoint &point, double c) const;

    /// Violation of the law at a point as twice the energy per area of a
    /// correction on half-spaces: c d^2 for an error d of the jump, t^2 / c for
    /// an error t of the traction. The compliance of a spring reduces it to c
    /// (d / (1 + c / K))^2. In contact the smaller one of the errors of gap and
    /// pressure counts, and with friction the error of the tangential traction
    /// beside that which follows from the jump.
    double
    violation(const InterfacePoint &point, double c) const;

    /// Penalty factor of the law in preconditioners, force per volume:
    /// @p of_tie for ties, in the directions with multipliers, reduced by the
    /// compliance of @p springs, the stiffnesses K at the nodes of a face.
    InterfaceStiffness
    penalty(const InterfaceStiffness              &of_tie,
            const std::vector<InterfaceStiffness> &springs) const;
  };
} // namespace mortise
