// The normals along which nodes of contact with friction keep bodies apart.
#pragma once

#include <deal.II/base/index_set.h>
#include <deal.II/base/tensor.h>

#include <mpi.h>

#include <vector>

namespace mortise
{
  struct Coupling;

  /// By owned ContactNode of @p coupling, which has friction, in the space of
  /// its multipliers: the direction of int psi n, across which a slip along the
  /// surface has the mean int psi s. Of unit length, or zero as
  /// ContactNode::normal, which is that of the tractions: on a curved face the
  /// two differ, since tractions are means with other weights. Collective.
  std::vector<dealii::Tensor<1, 3>>
  kinematic_normals(const Coupling         &coupling,
                    const dealii::IndexSet &owned_multiplier,
                    MPI_Comm                comm);
} // namespace mortise
