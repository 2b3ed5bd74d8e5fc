// What multipliers along normals stand for: areas, directions and gaps, from
// which signs and results of contact follow.
#pragma once

#include <mortise/mortar/coupling.h>

#include <vector>

namespace mortise
{
  /// One multiplier: the pressure at a node of the slave.
  struct NormalMultiplier
  {
    double                 area = 0.; ///< int psi
    dealii::Tensor<1, dim> normal;    ///< int psi n
    dealii::Tensor<1, dim> moment;    ///< int psi x cross n, about the origin
    /// int psi n . (x_master - x_slave) of the meshes: a volume, negative where
    /// they overlap.
    double gap = 0.;
    /// Is its value that of the pressure somewhere, or a mean of such values,
    /// so that its sign is that of the pressure?
    bool has_sign = true;
  };

  /// By owned multiplier of @p coupling, whose directions are normal. Collective.
  std::vector<NormalMultiplier>
  normal_multipliers(const Coupling         &coupling,
                     const dealii::IndexSet &owned_multiplier,
                     MPI_Comm                comm);
} // namespace mortise
