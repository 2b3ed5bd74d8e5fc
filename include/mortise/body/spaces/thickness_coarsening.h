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

    /// Of flat bodies the rows of find_rows_across(). Of other bodies the
    /// vertices stay and the functions are those of degree one, but for cells
    /// beside flat bodies, all of whose nodes stay, so that what these pull
    /// along goes on into the body as it would on the finest level.
    VertexCoarsening functions;

    /// The most steps across between two nodes that stay, over all ranks.
    unsigned int n_steps = 1;
  };

  /// @p nodes: of the finest level; bodies that are not flat have no hanging nodes unless their degree is one.
  /// @p beside: nodes of these, of any rank, that flat bodies pull along; cells with more than one of them are beside a flat body. Collective.
  ThicknessCoarsening
  make_thickness_coarsening(const NodalSpace                     &nodes,
                            const std::vector<NodalSpace::Index> &beside,
                            MPI_Comm                              comm);

  /// Can it be made, and is a body flat? Collective.
  bool
  coarsens_across_thickness(const std::vector<const Body *> &bodies);
} // namespace mortise
