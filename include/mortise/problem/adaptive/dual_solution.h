// The goal functional and its dual problem, whose solution weights errors by
// their effect on the goal. Source: Becker and Rannacher, An optimal control
// approach to a posteriori error estimation (2001).
#pragma once

#include <mortise/adapt/cycle_errors.h>
#include <mortise/output/functionals.h>
#include <mortise/problem/contact/global_unknowns.h>
#include <mortise/problem/input/quantity.h>
#include <mortise/problem/results/boundary_forces.h>
#include <mortise/solvers/linear_solver.h>

#include <vector>

namespace mortise
{
  /// The displacement or force of which @p quantity is a component. Throws
  /// InputError if its point lies outside the body. Collective.
  dealii::Tensor<1, dim>
  all_components(const Quantity                  &quantity,
                 const Bodies                    &bodies,
                 const std::vector<BodySolution> &solutions,
                 const BoundaryForces            &forces);

  double
  exact_value(const Quantity      &quantity,
              const Bodies        &bodies,
              const ExactSolution &exact);

  /// The derivative by the unknowns at @p solutions. Throws InputError if its point
  /// lies outside the body. Collective.
  LinearFunctional
  derivative(const Quantity                  &quantity,
             const Discretisation            &discretisation,
             const std::vector<BodySolution> &solutions);

  /// Solve the dual problem of @p quantity, with the shortenings of
  /// @p unknowns, at the solution @p solutions with @p forces, where the scene is
  /// linearised; @p start may be empty. The tangent stands in place of its
  /// transpose, from which pressures on deformed faces with a free rim make it
  /// differ. Collective.
  DualSolution
  solve_dual(const RunContext                &run,
             Discretisation                  &discretisation,
             LinearSolver                    &solver,
             GlobalUnknowns                  &unknowns,
             const Quantity                  &quantity,
             const std::vector<BodySolution> &solutions,
             const BoundaryForces            &forces,
             const std::vector<BodySolution> &start);
} // namespace mortise
