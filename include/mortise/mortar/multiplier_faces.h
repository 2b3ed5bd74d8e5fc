// Slave faces around this rank with the data from which a multiplier space
// follows: dofs, degrees, rims and coverage.
#pragma once

#include <mortise/interface/body_surface.h>

#include <array>
#include <vector>

namespace mortise
{
  /// Coverage of a slave face by partners.
  enum class FaceCoverage : unsigned char
  {
    none,    ///< no multipliers
    sliver,  ///< little, or less than by another interface: extends multipliers
             ///< of neighbours
    partial, ///< less than nine tenths: multipliers of degree 1
    full
  };

  /// @p covered: fraction; @p most: no other interface covers more of the face.
  FaceCoverage
  face_coverage(double covered, bool most);

  /// Partners of a slave face.
  struct PartnerState
  {
    FaceCoverage cover = FaceCoverage::none;
    std::array<bool, dim>
      has_free_displacement{}; ///< by component: some displacement of
                               ///< slave or master is free
    bool                                has_dual = false; ///< see LocalCoupling
    std::vector<dealii::Tensor<1, dim>> along_normals;    ///< see LocalCoupling
  };

  /// A slave face of an owned or ghost cell. Vertices and edges are numbered as
  /// in the basis.
  struct MultiplierFace
  {
    const TraceBasis *basis;
    FaceCoverage      cover = FaceCoverage::full;
    bool              has_free_displacement[dim]; ///< as in PartnerState
    std::array<std::vector<dealii::types::global_dof_index>, dim>
                 dofs; ///< [c][k] as in FaceTrace
    unsigned int edge_degree[4];
    unsigned int face_degree = 1;
    /// [c][edge]: all displacements of the edge are prescribed.
    bool rim[dim][4] = {};
    /// [c][vertex]: prescribed, or hanging.
    bool constrained_vertex[dim][4] = {};
  };

  /// The faces of @p slave, those of ghost cells included. Parameters as for MultiplierSpace.
  /// Collective.
  std::vector<MultiplierFace>
  collect_multiplier_faces(const Body                      &body,
                           const BodySurface               &slave,
                           const std::vector<PartnerState> &partners,
                           const std::vector<bool>         &constrained);
} // namespace mortise
