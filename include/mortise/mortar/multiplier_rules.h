// What a slave face says about the multipliers on it: the reduction beside rims
// by one face alone. It never knows other faces and makes no constraints.
#pragma once

#include <mortise/mortar/multiplier_faces.h>

#include <map>
#include <set>

namespace mortise
{
  /// What the faces around one dof say about its multiplier.
  struct MultiplierRecord
  {
    using Dofs = std::set<dealii::types::global_dof_index>;

    bool kept         = true;  ///< not above the reduced degree of a face
    bool on_full_face = false; ///< some face around it is well covered
    bool vertex       = false;
    bool on_rim       = false; ///< vertices: end of an edge across a rim ...
    bool across_kept  = false; ///< ... that has modes left
    bool can_follow = false; ///< the other side of some face around it is free
    Dofs neighbours;         ///< across the rim, off all rims
    Dofs diagonal;           ///< other vertices, off all rims
    Dofs merged;             ///< must have the same value
    /// Vertices on rims that give the value of one with none of the above.
    Dofs beside;

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
} // namespace mortise
