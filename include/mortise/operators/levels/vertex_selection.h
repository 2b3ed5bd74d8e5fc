// Coarse levels of vertices without a coarser mesh: a subset of the vertices,
// from which the others are interpolated.
#pragma once

#include <mortise/body/spaces/vertex_coarsening.h>
#include <mortise/operators/levels/vertex_matrix.h>

namespace mortise
{
  /// The vertices of @p fine that stay are a maximal set of which no two are
  /// coupled in one body, corners, edges and faces of bodies first; the others'
  /// values are weighted means of the nearest that stay, exact for linear
  /// functions, hence for rigid motions, unless those around a vertex lie in a
  /// plane beside it, as some do in edges. The selection is the same on any
  /// number of ranks. Collective.
  VertexCoarsening
  select_vertices(const VertexMatrix &fine);
} // namespace mortise
