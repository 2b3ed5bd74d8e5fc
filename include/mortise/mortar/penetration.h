// How deep bodies are inside each other between the nodes of their contact.
#pragma once

#include <mortise/mortar/coupling.h>

#include <functional>

namespace mortise
{
  /// In the numbering of the traces.
  struct TraceDisplacement
  {
    Vector free;       ///< coefficients; those of others do not matter
    Vector prescribed; ///< what is added to these
  };

  struct GapOfSurfaces
  {
    /// Left between bodies, at points of the slave, a length; empty: none.
    std::function<double(const dealii::Point<dim> &position)> offset;
    bool of_meshes = true; ///< does that between the meshes count?
  };

  /// The most by which the surfaces overlap at the quadrature points of the
  /// interface, along the normals of the slave's faces; zero where they do not.
  /// A length. Clips again. Collective.
  double
  largest_penetration(const Coupling          &coupling,
                      const TraceDisplacement &displacement,
                      const GapOfSurfaces     &gap,
                      MPI_Comm                 comm);
} // namespace mortise
