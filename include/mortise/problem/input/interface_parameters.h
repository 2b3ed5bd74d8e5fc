// Subsection Interface of a parameter file.
#pragma once

#include <deal.II/base/tensor.h>

#include <mortise/base/rigid_motion.h>
#include <mortise/contact/interface_law.h>
#include <mortise/interface/search.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace mortise
{
  /// One side of an interface.
  struct SideParameters
  {
    unsigned int             body = 0; ///< index into Parameters::bodies
    std::vector<std::string> boundaries;
  };

  /// How the master is moved to the slave before they are paired.
  enum class Periodicity : unsigned char
  {
    none,
    translation,
    rotation
  };

  struct InterfaceParameters
  {
    std::string    name;
    SideParameters slave; ///< carries the multiplier
    SideParameters master;
    Law            law              = Law::tie;
    bool           ignores_mesh_gap = false; ///< of contact
    std::string    multiplier       = "dual";
    std::string    offset           = "0";
    std::string    sliding          = "auto";
    bool           follows_bodies   = false; ///< what that means
    /// Of a tie: its normal force, and the time until which that is given.
    std::optional<std::string> preload;
    std::optional<double>      preload_until;
    /// Of contact: coefficients of friction, and the bound of Law = tresca.
    std::optional<std::string> friction_coefficient,
      static_friction_coefficient, friction_bound;
    /// Of springs.
    std::optional<std::string> normal_stiffness, tangential_stiffness;
    /// Adaptivity sets its lower bound from the relative motion of the sides.
    SearchDistance search_distance;
    unsigned int   quadrature_points = 0; ///< 0 ("auto"): by the degrees
    Periodicity    periodic          = Periodicity::none;
    std::optional<std::array<double, 3>> translation;
    /// Along the axis, in degrees; it goes through the point.
    std::optional<std::array<double, 3>> rotation;
    std::optional<std::array<double, 3>> reference_point; ///< else the origin

    /// A support: the master is a rigid copy of the slave's boundary, and the
    /// displacement takes the place of the offset.
    bool                                is_support = false;
    std::optional<dealii::Tensor<1, 3>> direction; ///< else the normal
    std::string                         boundary;  ///< path of its section

    /// From the master to where it meets the slave; the identity unless
    /// periodic.
    RigidMotion
    placement() const;

    /// The path of the section of the parameter file that it is from.
    std::string
    path() const
    {
      return is_support ? boundary : "Interface " + name;
    }
  };
} // namespace mortise
