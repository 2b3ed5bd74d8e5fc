// Frames at the nodes of slave faces: the normal of the true surface, one for
// each node that faces share, the mean of theirs, and two tangents.
#pragma once

#include <mortise/body/body.h>
#include <mortise/interface/body_surface.h>

#include <optional>
#include <vector>

namespace mortise
{
  /// Orthonormal, in rows: the outward normal n, and tangents t1, t2 = n x t1.
  using Frame = dealii::Tensor<2, dim>;

  /// The frame of a normal of unit length. t1 lies in the plane of n and of the
  /// axis that is most across it.
  Frame
  frame_of(const dealii::Tensor<1, dim> &normal);

  /// By function of a face: do faces that share its dof have the same node
  /// there? Not where nodes hang or degrees meet. @p dofs: of a component.
  std::vector<bool>
  have_shared_nodes(const TraceBasis                                   &basis,
                    const std::vector<dealii::types::global_dof_index> &dofs,
                    const Body                                         &body);

  /// By slave face and node, nodes as in TraceBasis. Where nodes hang, degrees
  /// meet or edges are sharp, faces keep normals of their own. All normals are
  /// the surface's direction if it has one. Collective.
  std::vector<std::vector<Frame>>
  slave_frames(const Body &body, const BodySurface &slave);

  /// A node of this rank where the normals of faces are more than 30 degrees
  /// off their mean. Collective.
  std::optional<dealii::Point<dim>>
  find_sharp_edge(const Body &body, const BodySurface &slave);

  /// Whether nothing of the normal displacement is left free at a node, by
  /// owned displacement dof; dofs of the first component stand for nodes.
  /// @p blocked: likewise, whether a displacement is prescribed or belongs to
  /// an earlier interface. Collective.
  std::vector<bool>
  blocked_normals(const Body                            &body,
                  const BodySurface                     &slave,
                  const std::vector<std::vector<Frame>> &frames,
                  const std::vector<bool>               &blocked);
} // namespace mortise
