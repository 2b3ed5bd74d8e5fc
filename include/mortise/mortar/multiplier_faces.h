// What the multiplier space needs to know of the slave faces around this rank:
// their dofs, degrees, rims and how well they are covered. It never decides
// what becomes of a multiplier.
#pragma once

#include <mortise/interface/body_surface.h>

#include <array>
#include <vector>

namespace mortise
{
  /// What a slave face meets on the other side.
  struct PartnerState
  {
    double coverage = 0.; ///< covered fraction of the face
    std::array<bool, dim>
      can_follow{}; ///< by component: some displacement there is free
  };

  /// A slave face of an owned or ghost cell. Edges are named by [a][side]: for
  /// degrees, the edge
  /// along face coordinate a at @p side of the other one; for rims, the edge at a = side.
  struct MultiplierFace
  {
    enum class Status : unsigned char
    {
      none,    ///< covered by less than a tenth: no multipliers of its own
      partial, ///< covered by less than nine tenths: multipliers of degree 1
      full
    };

    unsigned int degree = 1;
    Status       status = Status::full;
    bool         can_follow[dim]; ///< as in PartnerState
    std::array<std::vector<dealii::types::global_dof_index>, dim>
                 dofs; ///< [c][k] as in FaceTrace
    unsigned int edge_degree[2][2];
    unsigned int quad_degree = 1;
    bool         rim[dim][2]
            [2]; ///< [c][a][side]: all displacements of the edge are prescribed
    bool blocked_vertex[dim][4]; ///< [c][i + 2 j]: prescribed, or hanging
  };

  /// The faces with id @p boundary of owned and ghost cells. Parameters as for MultiplierSpace.
  /// Collective.
  std::vector<MultiplierFace>
  collect_multiplier_faces(const Body                      &body,
                           dealii::types::boundary_id       boundary,
                           const BodySurface               &slave,
                           const std::vector<PartnerState> &partners,
                           const std::vector<bool>         &blocked);
} // namespace mortise
