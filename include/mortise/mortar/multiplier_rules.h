// Rules of a single slave face for the reduction of multipliers beside rims.
#pragma once

#include <deal.II/lac/affine_constraints.h>

#include <mortise/mortar/multiplier_faces.h>

#include <map>
#include <set>
#include <utility>

namespace mortise
{
  /// Results of the rules of all faces around a dof for its multiplier.
  struct MultiplierRecord
  {
    using Dofs = std::set<dealii::types::global_dof_index>;

    bool kept         = true;  ///< not above the reduced degree of a face
    bool on_full_face = false; ///< some face around it has full coverage
    bool vertex       = false;
    bool constrained = false; ///< vertices: the displacement is constrained ...
    bool compensated = false; ///< ... and a mode is dropped instead
    bool on_rim      = false; ///< vertices: end of an edge across a rim ...
    bool across_kept = false; ///< ... that has modes left
    bool has_free_displacement =
      false; ///< some displacement is free on a face around it
    Dofs
      neighbours; ///< across the rim or from a constrained vertex, off all rims
    Dofs diagonal; ///< other vertices, off all rims
    Dofs merged;   ///< have the same value
    /// Vertices on rims that determine the value if all of the above are empty.
    Dofs beside;

    /// A constrained vertex that is at the end of no rim.
    bool
    has_no_rim() const
    {
      return constrained && !on_rim;
    }

    /// A vertex on a rim without a free vertex on the faces around it.
    bool
    is_isolated() const
    {
      return vertex && on_rim && !across_kept && neighbours.empty() &&
             merged.empty() && diagonal.empty();
    }
  };
  using MultiplierRecords =
    std::map<dealii::types::global_dof_index, MultiplierRecord>;

  /// By dof of the slave: the dof of the first component at its node, its
  /// component.
  using NodesAndComponents =
    std::map<dealii::types::global_dof_index,
             std::pair<dealii::types::global_dof_index, unsigned int>>;

  /// Add the rules of @p face for component @p c, by which there are at most as
  /// many multipliers as free displacements:
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

  /// After apply_multiplier_rules() for all faces: at a constrained vertex of a
  /// quadrilateral without a constrained edge the multiplier stays and the
  /// highest mode inside is dropped instead; at degree 1 the vertex has the
  /// mean of its neighbours.
  void
  compensate_constrained_vertices(const MultiplierFace &face,
                                  unsigned int          c,
                                  MultiplierRecords    &records);

  /// At the boundary and at kinks of the slave, edges of @p faces may hang on
  /// an edge of a larger cell without a face on the slave. The modes of that
  /// edge are multipliers, too, with the reduction beside rims: add them to
  /// @p nodes_and_components and @p records for @p n_directions components, unless
  /// @p one_sided, since no face has their Bernstein coefficients. After
  /// apply_multiplier_rules() for all faces.
  void
  add_edges_of_larger_cells(const std::vector<MultiplierFace> &faces,
                            unsigned int                       n_directions,
                            bool                               one_sided,
                            const dealii::AffineConstraints<double> &conformity,
                            NodesAndComponents &nodes_and_components,
                            MultiplierRecords  &records);
} // namespace mortise
