// Division of a boundary into smooth patches along its edges.
#pragma once

#include <mortise/body/boundary_faces.h>

#include <vector>

namespace mortise
{
  /// The faces @p boundary (of owned and ghost cells) in patches: faces around
  /// a vertex whose normals differ there by less than 60 degrees are in one.
  /// Patches are the same, in the same order, on any number of ranks; on some
  /// a patch may have no faces. Collective.
  std::vector<std::vector<BoundaryFace>>
  smooth_patches(const Body &body, const std::vector<BoundaryFace> &boundary);
} // namespace mortise
