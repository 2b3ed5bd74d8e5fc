// What a slave face says about the multipliers on it: the reduction beside rims
// by one face alone.
#pragma once

#include <deal.II/lac/affine_constraints.h>

#include <mortise/mortar/multiplier_faces.h>

#include <map>
#include <set>
#include <utility>

namespace mortise
{
  /// What the faces around one dof say about its multiplier.
  struct MultiplierRecord
  {
    using Dofs = std::set<dealii::types::global_dof_index>;

    bool kept         = true;  ///< not above the reduced degree of a face
    bool on_full_face = false; ///< some face around it is well covered
    bool vertex       = false;
    bool blocked      = false; ///< vertices: the displacement is
    bool made_up      = false; ///< ... and a mode is dropped instead
    bool on_rim       = false; ///< vertices: end of an edge across a rim ...
    bool across_kept  = false; ///< ... that has modes left
    bool can_follow = false; ///< some displacement is free on a face around it
    Dofs neighbours; ///< across the rim or from a blocked vertex, off all rims
    Dofs diagonal;   ///< other vertices, off all rims
    Dofs merged;     ///< must have the same value
    /// Vertices on rims that give the value of one with none of the above.
    Dofs beside;

    /// A blocked vertex that is at the end of no rim.
    bool
    is_alone() const
    {
      return blocked && !on_rim;
    }

    /// A vertex on a rim that finds no free one on the faces around it to
    /// take its value from.
    bool
    is_stranded() const
    {
      return vertex && on_rim && !across_kept && neighbours.empty() &&
             merged.empty() && diagonal.empty();
    }
  };
  using MultiplierRecords =
    std::map<dealii::types::global_dof_index, MultiplierRecord>;

  /// By dof on the slave: the dof of the first component there, its component.
  using MultiplierPlaces =
    std::map<dealii::types::global_dof_index,
             std::pair<dealii::types::global_dof_index, unsigned int>>;

  /// Add what @p face says about component @p c. As many multipliers are left
  /// as there are free displacements, or fewer:
  ///
  /// - quadrilaterals: in each direction one degree less for each rim at its
  ///   two ends;
  /// - triangles with r rims: degree p - r on the face and on its rims; on
  ///   other edges one degree less for each end whose displacement is
  ///   prescribed. With one rim, displacements that vanish there are lambda_c
  ///   P_(p-1), as many as P_(p-1) has functions.
  void
  apply_multiplier_rules(const MultiplierFace &face,
                         unsigned int          c,
                         MultiplierRecords    &records);

  /// Behind apply_multiplier_rules() for all faces: where the displacement of
  /// a quadrilateral's vertex is blocked, but that of no edge there, the
  /// multiplier stays and the highest mode inside goes in its place, from
  /// degree 2 on; at degree 1 the vertex takes the mean of its neighbours.
  void
  make_up_for_blocked_vertices(const MultiplierFace &face,
                               unsigned int          c,
                               MultiplierRecords    &records);

  /// At the margin of the slave and at its kinks edges of @p faces may hang on
  /// one of a larger cell that has no face there. What displacements have there
  /// follows the modes of that edge, which are multipliers, too, with the
  /// reduction beside rims: add these to @p places, and their @p records, for
  /// each of @p n_directions components. Where @p presses_only they are left
  /// out, since no face gives them Bernstein coefficients. Behind
  /// apply_multiplier_rules() for all faces.
  void
  add_edges_of_larger_cells(const std::vector<MultiplierFace> &faces,
                            unsigned int                       n_directions,
                            bool                               presses_only,
                            const dealii::AffineConstraints<double> &conformity,
                            MultiplierPlaces                        &places,
                            MultiplierRecords                       &records);
} // namespace mortise
