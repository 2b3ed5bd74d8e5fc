// The law of an interface: how the traction that its multipliers carry depends
// on how its sides are apart. It knows no mesh and no matrix.
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
    contact, ///< gap >= 0, pressure >= 0, and one of both is zero
    spring   ///< traction = K times the jump
  };

  /// As parameter files call them, in the order of Law.
  const std::vector<std::string> &
  interface_law_names();

  inline const std::string &
  name_of(Law law)
  {
    return interface_law_names()[static_cast<unsigned int>(law)];
  }

  /// Components of the jump that have a multiplier.
  enum class HeldDirections : unsigned char
  {
    all,
    normal ///< of the slave
  };

  /// Of a thin layer: traction by opening, along its normal and across, force
  /// per volume. Infinite where nothing opens.
  struct Stiffness
  {
    double normal     = std::numeric_limits<double>::infinity();
    double tangential = std::numeric_limits<double>::infinity();
  };

  /// The sides of an interface at a point of the slave.
  struct InterfacePoint
  {
    dealii::Point<3>     position;
    dealii::Tensor<1, 3> normal;      ///< of the slave: outward, of unit length
    dealii::Tensor<1, 3> jump;        ///< u_master - u_slave, a length
    dealii::Tensor<1, 3> mesh_gap;    ///< X_master - X_slave, a length
    double               offset = 0.; ///< gap beside that of the meshes
    dealii::Tensor<1, 3> traction;    ///< lambda, on the master: force per area
  };

  struct InterfaceLaw
  {
    Law            law  = Law::tie;
    HeldDirections held = HeldDirections::all;
    /// Does the gap between the meshes count? Else they stand for surfaces that
    /// coincide.
    bool has_mesh_gap = false;
    /// K of a spring, at a point of the slave; null for other laws.
    std::function<Stiffness(const dealii::Point<3> &)> stiffness;

    /// Do multipliers have a sign, and an active set?
    bool
    is_one_sided() const
    {
      return law == Law::contact;
    }

    /// Has the constraint a compliance?
    bool
    is_compliant() const
    {
      return law == Law::spring;
    }

    /// g = n . (jump + mesh gap) + offset, a length; negative where the sides
    /// overlap.
    double
    gap(const InterfacePoint &point) const;

    /// Does the point press, where @p c is a pressure by gap?
    bool
    presses(const InterfacePoint &point, double c) const
    {
      return point.traction * point.normal > c * gap(point);
    }

    /// Twice the energy per area that it takes to mend what is broken at a
    /// point, where half-spaces take c d^2 for sides that are a length d off,
    /// and t^2 / c for a traction t that is not to be there. A spring gives way
    /// further when it is mended: c (d / (1 + c / K))^2. Of gap and pressure of
    /// contact at the same point what is less counts.
    double
    violation(const InterfacePoint &point, double c) const;

    /// What stands for the constraint in the penalty of a preconditioner, where
    /// @p of_tie is that of a tie, and @p springs are K at the nodes of a face:
    /// less where springs give way. Force per volume.
    Stiffness
    penalty(double of_tie, const std::vector<Stiffness> &springs) const;
  };
} // namespace mortise
