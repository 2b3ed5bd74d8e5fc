// Errors against an exact solution, and functionals of a solution. It never
// prints.
#pragma once

#include <mortise/base/types.h>
#include <mortise/material/exact_solution.h>
#include <mortise/mortar/coupling.h>
#include <mortise/operators/scene_system.h>

#include <optional>
#include <string>
#include <vector>

namespace mortise
{
  /// Relative errors over the whole scene.
  struct DisplacementErrors
  {
    double l2     = 0.; ///< |u - u_h| / |u| in L2
    double energy = 0.; ///< |u - u_h| / |u| in the norm int sigma : eps
  };

  /// Gauss rule of degree + 3 points per direction. Collective.
  DisplacementErrors
  displacement_errors(const Bodies                  &bodies,
                      const std::vector<BodyVector> &displacements,
                      const ExactSolution           &exact);

  /// |lambda - t| / |t| in L2 over the slave faces with a partner, t the exact
  /// traction, all
  /// interfaces together (over |sigma| there if t is zero); @p coefficients by interface, see multiplier_on_faces(). Collective.
  double
  multiplier_error(
    const Bodies                                        &bodies,
    const std::vector<Coupling>                         &couplings,
    const std::vector<unsigned int>                     &slave_bodies,
    const std::vector<std::vector<std::vector<double>>> &coefficients,
    const ExactSolution                                 &exact);

  /// Displacement at a point of a body; absent if the point lies outside
  /// (farther than rounding). Collective.
  std::optional<dealii::Tensor<1, dim>>
  point_value(const Body               &body,
              const BodyVector         &displacement,
              const dealii::Point<dim> &point);

  /// Force on a boundary, int sigma_h n. Collective.
  dealii::Tensor<1, dim>
  resultant(const Body                &body,
            const BodyVector          &displacement,
            dealii::types::boundary_id boundary);
} // namespace mortise
