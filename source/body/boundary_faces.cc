#include <mortise/body/boundary_faces.h>

namespace mortise
{
  std::vector<BoundaryFace>
  boundary_faces(const Body &body, const dealii::types::boundary_id boundary)
  {
    std::vector<BoundaryFace> faces;
    for (const auto &cell : body.dof_handler.active_cell_iterators())
      if (!cell->is_artificial() && cell->at_boundary())
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary() &&
              cell->face(f)->boundary_id() == boundary)
            faces.push_back({cell, f});
    return faces;
  }
} // namespace mortise
