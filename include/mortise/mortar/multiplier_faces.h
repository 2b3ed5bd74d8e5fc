// What the multiplier space needs to know of the slave faces around this rank:
// their dofs, degrees, rims and how well they are covered.
#pragma once

#include <mortise/interface/body_surface.h>

#include <array>
#include <vector>

namespace mortise
{
  /// How much of a slave face has a partner.
  enum class Cover : unsigned char
  {
    none,    ///< no multipliers
    sliver,  ///< little, or less than another interface has of it: it goes on
             ///< with the multipliers of faces beside it
    partial, ///< less than nine tenths: multipliers of degree 1
    full
  };

  /// @p covered: the fraction; @p most: no interface has more of the face.
  Cover
  cover_of(double covered, bool most);

  /// What a slave face meets on the other side.
  struct PartnerState
  {
    Cover cover = Cover::none;
    std::array<bool, dim>
      can_follow{}; ///< by component: some displacement there is free, of
                    ///< the slave or of the master
    bool has_dual = false; ///< multipliers are dual: see LocalCoupling
    std::vector<dealii::Tensor<1, dim>> along_normals; ///< see LocalCoupling
  };

  /// A slave face of an owned or ghost cell. Vertices and edges are numbered as
  /// in the basis.
  struct MultiplierFace
  {
    const TraceBasis *basis;
    Cover             cover = Cover::full;
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

  /// The faces of @p slave, those of ghost cells included. Parameters as for MultiplierSpace.
  /// Collective.
  std::vector<MultiplierFace>
  collect_multiplier_faces(const Body                      &body,
                           const BodySurface               &slave,
                           const std::vector<PartnerState> &partners,
                           const std::vector<bool>         &blocked);
} // namespace mortise
