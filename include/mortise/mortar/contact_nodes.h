// The nodes of contact: integrals of their multipliers, for the active set,
// friction and results.
#pragma once

#include <deal.II/base/index_set.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <mortise/base/types.h>
#include <mpi.h>

#include <array>
#include <vector>

namespace mortise
{
  struct Coupling;

  /// A node of the slave, or a Bernstein coefficient of its traction. Its
  /// multipliers are the pressure, or with friction the components of the
  /// traction that have one; vectors below have an entry for each of them.
  struct ContactNode
  {
    unsigned int n_multipliers = 0; ///< at most dim
    /// Among the owned ones of the scene.
    std::array<unsigned int, dim> multipliers{};
    /// Along the pressure, of unit length; zero where the normal displacement
    /// is prescribed. What is across it is tangential.
    dealii::Tensor<1, dim> normal;
    /// The rotation from the normal to that across which a slip along the
    /// surface has the mean int psi s. On curved faces the two differ, since
    /// tractions are means with other weights.
    dealii::Tensor<2, dim> kinematic;
    /// With friction the tangential part of traction() is this times that in
    /// the frame of the node: a mean of the rotations from its normal to those
    /// around it.
    dealii::Tensor<2, dim> rotation;
    double                 length_of_mean = 1.; ///< of the mean of the normals
    /// int psi, of the normal; and by multiplier: at a rim a component that is
    /// prescribed there has the share of the rim in addition.
    double                  area = 0.;
    std::array<double, dim> areas{};
    dealii::Point<dim>      position; ///< in the body: int psi X / area
    /// By multiplier, of its direction d: int psi d, and int psi x cross d
    /// about the origin.
    std::array<dealii::Tensor<1, dim>, dim> forces, moments;
    /// Likewise with the normals n of the slave: int psi n . d, the same times
    /// the coefficient of a unit pressure, and int psi (n . d) n, the part of
    /// the force that presses.
    std::array<double, dim>                 pressures{}, pressed_areas{};
    std::array<dealii::Tensor<1, dim>, dim> pressure_forces;
    /// By multiplier, the mean of x_master - x_slave in its direction.
    dealii::Tensor<1, dim> opening;
    /// Complementarity parameter c, about E / h of the softer side, force per
    /// volume.
    double complementarity = 0.;

    /// Mean of the mesh gap n . (x_master - x_slave), a length; negative on
    /// penetration.
    double
    gap() const
    {
      return kinematic_normal() * opening;
    }

    bool
    has_normal() const
    {
      return normal.norm_square() > 0.;
    }

    /// The direction of multiplier @p r in space, of unit length.
    dealii::Tensor<1, dim>
    axis(const unsigned int r) const
    {
      return forces[r] / forces[r].norm();
    }

    dealii::Tensor<1, dim>
    kinematic_normal() const
    {
      return kinematic * normal;
    }

    /// The entries for each multiplier of a vector in space.
    dealii::Tensor<1, dim>
    along_axes(const dealii::Tensor<1, dim> &in_space) const
    {
      dealii::Tensor<1, dim> result;
      for (unsigned int r = 0; r < n_multipliers; ++r)
        result[r] = in_space * axis(r);
      return result;
    }

    dealii::Tensor<1, dim>
    in_space(const dealii::Tensor<1, dim> &along_axes) const
    {
      dealii::Tensor<1, dim> result;
      for (unsigned int r = 0; r < n_multipliers; ++r)
        result += along_axes[r] * axis(r);
      return result;
    }

    /// What of @p value is across the normal.
    dealii::Tensor<1, dim>
    tangential(const dealii::Tensor<1, dim> &value) const
    {
      return value - (normal * value) * normal;
    }

    /// The tangential part of @p traction in the frame of the node.
    dealii::Tensor<1, dim>
    in_frame(const dealii::Tensor<1, dim> &traction) const
    {
      return invert(rotation) * tangential(traction);
    }

    /// Of the coefficients @p lambda, by owned multiplier of the scene: the force
    /// of the node per area.
    dealii::Tensor<1, dim>
    traction(const double *lambda) const
    {
      dealii::Tensor<1, dim> result;
      for (unsigned int r = 0; r < n_multipliers; ++r)
        result[r] = areas[r] / area * lambda[multipliers[r]];
      return result;
    }

    double
    pressure(const double *lambda) const
    {
      return normal * traction(lambda) / length_of_mean;
    }

    /// The mean of @p weighted, integrals with psi by owned multiplier.
    dealii::Tensor<1, dim>
    mean(const double *weighted) const
    {
      dealii::Tensor<1, dim> result;
      for (unsigned int r = 0; r < n_multipliers; ++r)
        result[r] = weighted[multipliers[r]] / areas[r];
      return result;
    }
  };

  /// Owned nodes of @p coupling, which is one-sided, in the order of their
  /// multipliers. Collective.
  std::vector<ContactNode>
  contact_nodes(const Coupling         &coupling,
                const dealii::IndexSet &owned_multiplier,
                MPI_Comm                comm);
} // namespace mortise
