// How far a contact opens beyond where it pulls: what pressures look like
// beside its edge, on any mesh, says where the edge goes.
#pragma once

#include <mortise/contact/multiplier_places.h>

#include <vector>

namespace mortise
{
  /// Where bodies are held together beyond the edge of their contact by the
  /// length d, the pressure at the distance s from where they part is K1
  /// s^(1/2) - K2 s^(-1/2), d = 2 K2 / K1: it pulls up to s = d / 2 only. Sets
  /// that open just what pulls halve d each time and need the more steps the
  /// finer the mesh is. Source: the singular solutions of a half-plane,
  /// Johnson, Contact Mechanics (1985), sections 2.8 and 5.1.
  class ContactEdge
  {
  public:
    /// Collective.
    ContactEdge(MultiplierPlaces places, MPI_Comm comm);

    /// Add to @p turns, the multipliers whose sign is wrong, active ones no farther from these than
    /// these are wide from the edge on. Both by owned multiplier. Collective.
    void
    extend(const std::vector<bool> &active, std::vector<bool> &turns) const;

  private:
    const MultiplierPlaces places;
    const unsigned int     n_surfaces;
    const MPI_Comm         comm;
  };
} // namespace mortise
