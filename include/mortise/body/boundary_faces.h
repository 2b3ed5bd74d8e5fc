// The faces of a body on some of its boundaries.
#pragma once

#include <mortise/body/body.h>

#include <vector>

namespace mortise
{
  /// Face @p number of @p cell.
  struct BoundaryFace
  {
    Body::CellIterator cell;
    unsigned int       number;
  };

  /// Faces of the owned and ghost cells of @p body on any of @p boundaries, in the order of the cells. Who
  /// sums over faces skips those of ghost cells.
  std::vector<BoundaryFace>
  boundary_faces(const Body                                    &body,
                 const std::vector<dealii::types::boundary_id> &boundaries);

  /// Of one boundary.
  std::vector<BoundaryFace>
  boundary_faces(const Body &body, dealii::types::boundary_id boundary);
} // namespace mortise
