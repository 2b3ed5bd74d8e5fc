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

  /// Has a slave face with this covered fraction all its multipliers?
  bool
  is_fully_covered(double coverage);

  /// A slave face of an owned or ghost cell. Vertices and edges are numbered as
  /// in the basis.
  struct MultiplierFace
  {
    enum class Status : unsigned char
    {
      none,    ///< covered by less than a tenth: no multipliers of its own
      partial, ///< covered by less than nine tenths: multipliers of degree 1
      full
    };

    const TraceBasis *basis;
    Status            status = Status::full;
    bool              can_follow[dim]; ///< as in PartnerState
    std::array<std::vector<dealii::types::global_dof_index>, dim>
                 dofs; ///< [c][k] as in FaceTrace
    unsigned int edge_degree[4];
    unsigned int face_degree = 1;
    /// [c][edge]: all displacements of the edge are prescribed.
    bool rim[dim][4] = {};
    /// [c][vertex]: prescribed, or hanging.
    bool blocked_vertex[dim][4] = {};
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
