#include <mortise/body/boundary_faces.h>

#include <algorithm>

namespace mortise
{
  using dealii::types::boundary_id;

  std::vector<BoundaryFace>
  boundary_faces(const Body &body, const std::vector<boundary_id> &boundaries)
  {
    std::vector<BoundaryFace> faces;
    for (const auto &cell : body.dof_handler.active_cell_iterators())
      if (!cell->is_artificial() && cell->at_boundary())
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary() &&
              std::find(boundaries.begin(),
                        boundaries.end(),
                        cell->face(f)->boundary_id()) != boundaries.end())
            faces.push_back({cell, f});
    return faces;
  }

  std::vector<BoundaryFace>
  boundary_faces(const Body &body, const boundary_id boundary)
  {
    return boundary_faces(body, std::vector<boundary_id>{boundary});
  }
} // namespace mortise
