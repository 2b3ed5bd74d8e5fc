// The quantity whose error a run with a target is to make small as a
// functional, and its dual problem: whose solution says what an error anywhere
// does to it. Source: Becker and Rannacher, An optimal control approach to a
// posteriori error estimation (2001).
#pragma once

#include <mortise/adapt/cycle_errors.h>
#include <mortise/output/functionals.h>
#include <mortise/problem/contact/preloads.h>
#include <mortise/problem/input/quantity.h>
#include <mortise/problem/results/boundary_forces.h>
#include <mortise/solvers/linear_solver.h>

#include <vector>

namespace mortise
{
  /// All components of the displacement or force of which @p quantity is one. Throws
  /// InputError where a point lies outside its body. Collective.
  dealii::Tensor<1, dim>
  all_components(const Quantity                  &quantity,
                 const Bodies                    &bodies,
                 const std::vector<BodySolution> &solutions,
                 const BoundaryForces            &forces);

  double
  exact_value(const Quantity      &quantity,
              const Bodies        &bodies,
              const ExactSolution &exact);

  /// The derivative by what is solved for. Throws InputError where a
  /// point lies outside. Collective.
  LinearFunctional
  derivative(const Quantity &quantity, const Discretisation &discretisation);

  /// Solve the system of @p discretisation with the shortenings of @p preloads, whose last solution is @p solutions with
  /// @p forces, for the derivative of @p quantity; @p start may be empty. Collective.
  DualSolution
  solve_dual(const RunContext                &run,
             const Discretisation            &discretisation,
             LinearSolver                    &solver,
             Preloads                        &preloads,
             const Quantity                  &quantity,
             const std::vector<BodySolution> &solutions,
             const BoundaryForces            &forces,
             const std::vector<BodySolution> &start);
} // namespace mortise
