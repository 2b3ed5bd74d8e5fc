// Area, centroid and moments of inertia of a boundary, by the points at which
// tractions are integrated: total forces and moments become tractions with
// them.
#pragma once

#include <mortise/body/body.h>

#include <functional>

namespace mortise
{
  struct BoundaryArea
  {
    double             area = 0.;
    dealii::Point<dim> centroid;
    /// int |r|^2 I - r r^T, r from the centroid: what a field w x r has as
    /// moment is this times w. Length to the fourth.
    dealii::SymmetricTensor<2, dim> inertia;
  };

  /// Of the faces of @p boundary on the undeformed @p body. Collective.
  BoundaryArea
  boundary_area(const Body &body, dealii::types::boundary_id boundary);

  /// The traction, force per area, whose resultant is @p force and whose moment
  /// about the centroid is @p moment: force / area + w x r, of which the second
  /// has no resultant.
  std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &)>
  equivalent_traction(const BoundaryArea           &boundary,
                      const dealii::Tensor<1, dim> &force,
                      const dealii::Tensor<1, dim> &moment);
} // namespace mortise
