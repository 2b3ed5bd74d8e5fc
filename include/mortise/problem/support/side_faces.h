// The faces of one side of an interface.
#pragma once

#include <mortise/body/boundary_faces.h>
#include <mortise/operators/scene_system.h>
#include <mortise/problem/input/parameters.h>

#include <string>
#include <vector>

namespace mortise
{
  /// Faces of one side of an interface, see boundary_faces(); @p where stands in
  /// messages about boundaries that do not exist.
  std::vector<BoundaryFace>
  side_faces(const Bodies         &bodies,
             const SideParameters &side,
             const std::string    &where);
} // namespace mortise
