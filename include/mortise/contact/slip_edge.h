// Prediction of the edge of slip from tractions above their bounds, which saves
// active sets on fine meshes.
#pragma once

#include <deal.II/base/tensor.h>

#include <mortise/contact/node_positions.h>
#include <mpi.h>

#include <vector>

namespace mortise
{
  /// Of a node that stuck; vectors in space.
  struct TangentialForce
  {
    enum Kind
    {
      begins,   ///< to slip, since the force exceeds its bound
      may_slip, ///< because of its neighbours
      other
    } kind = other;
    dealii::Tensor<1, 3> force;
    double               bound = 0.;
  };

  /// Nodes that begin to slip give what exceeds their bound to those beside
  /// them, which slip in turn. Chooses the nearest nodes that can bear
  /// together, up to their bounds, the part of it that they bear in a line
  /// contact of Cattaneo and Mindlin; the rest goes farther inside. Without
  /// that each set
  /// moves the edge by about the same length. @p forces and the result are by
  /// owned node; the latter is the direction of the force of nodes that slip
  /// then, zero for all others. Collective.
  std::vector<dealii::Tensor<1, 3>>
  extend_slip(const NodePositions                &positions,
              const std::vector<TangentialForce> &forces,
              MPI_Comm                            comm);
} // namespace mortise
