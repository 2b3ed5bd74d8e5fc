// Linear elasticity with three planes of symmetry, as of wood, layers and
// fibres.
#pragma once

#include <mortise/material/constant_defect.h>
#include <mortise/material/linear_elastic.h>

#include <optional>
#include <string>

namespace mortise
{
  /// Constants in the axes x, y, z of the material. nu_ij is the contraction
  /// along j per extension along i under tension along i; with the stiffness
  /// symmetric nu_ij / E_i = nu_ji / E_j.
  struct Orthotropic
  {
    std::array<double, 3> young_moduli   = {{0., 0., 0.}}; ///< E_x, E_y, E_z
    std::array<double, 3> poisson_ratios = {{0., 0., 0.}}; ///< xy, yz, zx
    std::array<double, 3> shear_moduli   = {{0., 0., 0.}}; ///< G_xy, G_yz, G_zx
    /// Rotation of the axes of the material, in degrees about the fixed x, then
    /// y, then z.
    std::array<double, 3> axes = {{0., 0., 0.}};

    /// The reason for which the stiffness is not positive definite, if any.
    std::optional<ConstantDefect>
    defect() const;

    /// The law in the axes of the scene.
    template <typename Number = double>
    AnisotropicLaw<Number>
    law() const;

    /// All of it: there is no mixed form.
    template <typename Number = double>
    AnisotropicLaw<Number>
    displacement_law() const
    {
      return law<Number>();
    }

    LinearElastic::Averages
    averages() const;
  };
} // namespace mortise
