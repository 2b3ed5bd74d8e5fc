// Frames (n, t1, t2) at the nodes of slave faces: the averaged normal of the
// faces that share a node, and two tangents.
#pragma once

#include <mortise/body/body.h>
#include <mortise/interface/body_surface.h>

#include <optional>
#include <vector>

namespace mortise
{
  /// Orthonormal rows: the outward normal n, tangents t1 and t2 = n x t1.
  using Frame = dealii::Tensor<2, dim>;

  /// The frame of a unit normal n; t1 lies in the plane of n and the axis at
  /// the largest angle to it.
  Frame
  frame_of(const dealii::Tensor<1, dim> &normal);

  /// By function of a face: do faces that share its dof share its node, too?
  /// Not at hanging nodes or between degrees. @p dofs: of a component.
  std::vector<bool>
  have_shared_nodes(const TraceBasis                                   &basis,
                    const std::vector<dealii::types::global_dof_index> &dofs,
                    const Body                                         &body);

  /// By slave face and node (see TraceBasis). At hanging nodes, between degrees
  /// and at sharp edges faces have normals of their own. If the surface has a
  /// direction, it is the normal. Collective.
  std::vector<std::vector<Frame>>
  slave_frames(const Body &body, const BodySurface &slave);

  /// The same with the normals @p normals of each face in place of its own; an
  /// empty entry stands for its own. Collective.
  std::vector<std::vector<Frame>>
  slave_frames(const Body                                             &body,
               const BodySurface                                      &slave,
               const std::vector<std::vector<dealii::Tensor<1, dim>>> &normals);

  /// A node of this rank at which a face's normal differs from the mean by more
  /// than 30 degrees. Collective.
  std::optional<dealii::Point<dim>>
  find_sharp_edge(const Body &body, const BodySurface &slave);

  /// By owned displacement dof of the first component: is the normal
  /// displacement of its node constrained? @p constrained: by owned displacement
  /// dof, whether it is prescribed or belongs to an earlier interface.
  /// Collective.
  std::vector<bool>
  constrained_normals(const Body                            &body,
                      const BodySurface                     &slave,
                      const std::vector<std::vector<Frame>> &frames,
                      const std::vector<bool>               &constrained);
} // namespace mortise
