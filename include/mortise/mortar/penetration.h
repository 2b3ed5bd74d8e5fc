// How deep bodies are inside each other between the nodes of their contact.
#pragma once

#include <mortise/mortar/interface_points.h>

namespace mortise
{
  /// The most by which the surfaces overlap at the quadrature points of the
  /// interface, along the normals of the slave's faces; zero where they do not.
  /// A length. Clips again. Collective.
  double
  largest_penetration(const Coupling          &coupling,
                      const TraceDisplacement &displacement,
                      const Offset            &offset,
                      MPI_Comm                 comm);
} // namespace mortise
