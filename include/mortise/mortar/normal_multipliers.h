// Integrals of multipliers along normals: area, direction and weighted gap, for
// the active set and the results of contact.
#pragma once

#include <deal.II/base/index_set.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <mortise/base/types.h>
#include <mpi.h>

#include <vector>

namespace mortise
{
  struct Coupling;

  /// A multiplier of contact: the pressure at a node of the slave, or a
  /// Bernstein coefficient of the pressure.
  struct NormalMultiplier
  {
    double                 area = 0.; ///< int psi
    dealii::Point<dim>     position;  ///< int psi x / area
    dealii::Tensor<1, dim> normal;    ///< int psi n
    dealii::Tensor<1, dim> moment;    ///< int psi x cross n, about the origin
    /// Weighted gap int psi n . (x_master - x_slave) of the meshes, a volume;
    /// negative on penetration.
    double gap = 0.;
    /// Complementarity parameter c, about E / h of the softer side, force per
    /// volume.
    double complementarity = 0.;
  };

  /// By owned multiplier of @p coupling, which has ConstrainedDirections::normal.
  /// Collective.
  std::vector<NormalMultiplier>
  normal_multipliers(const Coupling         &coupling,
                     const dealii::IndexSet &owned_multiplier,
                     MPI_Comm                comm);
} // namespace mortise
