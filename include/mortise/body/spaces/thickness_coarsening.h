// Bodies of flat cells: functions that have all degrees along the plane of the
// cells and are linear across a stack of them, which is how thin bodies bend
// and stretch. Functions of lower degree bend too stiffly, whatever smooths the
// rest. It knows nothing of matrices.
#pragma once

#include <mortise/body/spaces/flat_bodies.h>
#include <mortise/body/spaces/vertex_coarsening.h>

#include <vector>

namespace mortise
{
  struct ThicknessCoarsening
  {
    std::vector<bool> flat; ///< by index of the body

    /// Of flat bodies the ends of the lines of nodes across the plane of the
    /// cells stay, and as many nodes between them that no more than
    /// max_steps_across of the line's steps are between two that stay; values
    /// at the others are linear along the line. Of other bodies the vertices
    /// stay; the functions are those of degree one.
    VertexCoarsening functions;

    /// The most steps between two nodes that stay, over all ranks.
    unsigned int n_steps = 1;

    static constexpr unsigned int max_steps_across = 12;
  };

  /// @p nodes: of the finest level; bodies that are not flat have no hanging nodes unless their degree is one.
  /// @p kept: nodes of these, of any rank, that stay besides: what flat bodies pull along. Collective.
  ThicknessCoarsening
  make_thickness_coarsening(const NodalSpace                     &nodes,
                            const std::vector<NodalSpace::Index> &kept,
                            MPI_Comm                              comm);

  /// Can it be made, and is a body flat? Collective.
  bool
  coarsens_across_thickness(const std::vector<const Body *> &bodies);
} // namespace mortise
