// Constitutive law of an interface: its traction lambda as a function of the
// jump of the displacement.
#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

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
    contact, ///< gap >= 0, pressure >= 0, pressure gap = 0
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
      return law == Law::contact;
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

    /// Violation of the law at a point as twice the energy per area of a
    /// correction on half-spaces: c d^2 for an error d of the jump, t^2 / c for
    /// an error t of the traction. The compliance of a spring reduces it to c
    /// (d / (1 + c / K))^2. In contact the smaller one of the errors of gap and
    /// pressure counts.
    double
    violation(const InterfacePoint &point, double c) const;

    /// Penalty factor of the law in preconditioners, force per volume:
    /// @p of_tie for ties, reduced by the compliance of @p springs, the
    /// stiffnesses K at the nodes of a face.
    InterfaceStiffness
    penalty(double                                 of_tie,
            const std::vector<InterfaceStiffness> &springs) const;
  };
} // namespace mortise
