#include <mortise/problem/support/side_faces.h>

namespace mortise
{
  using namespace dealii;

  std::vector<BoundaryFace>
  side_faces(const Bodies         &bodies,
             const SideParameters &side,
             const std::string    &where)
  {
    const Body                     &body = *bodies[side.body];
    std::vector<types::boundary_id> ids;
    for (const std::string &boundary : side.boundaries)
      ids.push_back(body.boundary_id(boundary, where));
    return boundary_faces(body, ids);
  }
} // namespace mortise
