// Errors against an exact solution.
#pragma once

#include <mortise/base/types.h>
#include <mortise/material/exact_solution.h>
#include <mortise/mortar/coupling.h>
#include <mortise/operators/scene_solution.h>

#include <vector>

namespace mortise
{
  /// Relative errors over the whole scene.
  struct SolutionErrors
  {
    double displacement_l2 = 0.; ///< |u - u_h| / |u| in L2
    double displacement_h1 = 0.; ///< |grad(u - u_h)| / |grad u| in L2
    /// |u - u_h| / |u| in the norm int sigma : eps; in mixed form that of
    /// displacement and pressure, int 2 mu eps : eps + lambda_u (tr eps)^2 + c
    /// p^2, which is the same for the exact solution.
    double energy = 0.;
    /// Of the mean pressure -tr(sigma) / 3 over the bodies in mixed form (over
    /// |sigma| there if it is zero).
    double pressure_l2 = 0.;
  };

  /// Gauss rule of degree + 3 points per direction. Collective.
  SolutionErrors
  solution_errors(const Bodies                    &bodies,
                  const std::vector<BodySolution> &solutions,
                  const ExactSolution             &exact);

  /// The bodies of an interface.
  struct TiedBodies
  {
    unsigned int slave;
    unsigned int bearing; ///< whose exact stress is that of the interface
  };

  /// |lambda - t| / |t| in L2 over the slave faces with a partner, t the exact
  /// traction, all interfaces together (over |sigma| there if t is zero),
  /// without components that nothing can follow; @p coefficients by interface,
  /// see multiplier_on_faces(). Collective.
  double
  multiplier_error(
    const Bodies                                        &bodies,
    const std::vector<Coupling>                         &couplings,
    const std::vector<TiedBodies>                       &tied,
    const std::vector<std::vector<std::vector<double>>> &coefficients,
    const ExactSolution                                 &exact);
} // namespace mortise
