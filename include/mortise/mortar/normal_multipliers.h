// What multipliers along normals stand for: areas, directions and gaps, from
// which signs and results of contact follow.
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

  /// One multiplier: the pressure at a node of the slave, or a coefficient of
  /// it that has its sign.
  struct NormalMultiplier
  {
    double                 area = 0.; ///< int psi
    dealii::Point<dim>     place;     ///< int psi x over it
    dealii::Tensor<1, dim> normal;    ///< int psi n
    dealii::Tensor<1, dim> moment;    ///< int psi x cross n, about the origin
    /// int psi n . (x_master - x_slave) of the meshes: a volume, negative where
    /// they overlap.
    double gap = 0.;
    /// Pressure by gap that is worth as much, about E / h of the softer side,
    /// force per volume.
    double stiffness = 0.;
  };

  /// By owned multiplier of @p coupling, whose directions are normal. Collective.
  std::vector<NormalMultiplier>
  normal_multipliers(const Coupling         &coupling,
                     const dealii::IndexSet &owned_multiplier,
                     MPI_Comm                comm);
} // namespace mortise
