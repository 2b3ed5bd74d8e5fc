// Prediction of the edge of a contact from the singular pressures beside it,
// which saves active sets on fine meshes.
#pragma once

#include <mortise/contact/node_positions.h>
#include <mpi.h>

#include <vector>

namespace mortise
{
  /// If the active set reaches the length d beyond the true edge, the pressure
  /// at the distance s from its end is K1 s^(1/2) - K2 s^(-1/2), d = 2 K2 / K1,
  /// hence negative only for s < d / 2. Sets that open negative pressures alone
  /// halve d each time and need more steps on finer meshes. Source: the
  /// singular solutions of a half-plane, Johnson, Contact Mechanics (1985),
  /// sections 2.8 and 5.1.
  class ContactEdge
  {
  public:
    /// Collective.
    ContactEdge(NodePositions positions, MPI_Comm comm);

    /// Add to @p turns, the multipliers of wrong sign, the active ones within a
    /// distance of them equal to the width of their zone beside the edge. Both
    /// by owned multiplier. Collective.
    void
    extend(const std::vector<bool> &active, std::vector<bool> &turns) const;

  private:
    const NodePositions positions;
    const unsigned int  n_surfaces;
    const MPI_Comm      comm;
  };
} // namespace mortise
