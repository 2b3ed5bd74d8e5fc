// The number whose error a run with a target is to make small, and its dual
// problem: whose solution says what an error anywhere does to it. Source:
// Becker and Rannacher, An optimal control approach to a posteriori error
// estimation (2001).
#pragma once

#include <mortise/output/functionals.h>
#include <mortise/problem/contact/preloads.h>
#include <mortise/problem/results/boundary_forces.h>
#include <mortise/solvers/linear_solver.h>

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace mortise
{
  class Quantity
  {
  public:
    /// Nothing where Adaptivity/Quantity is empty; throws InputError where it
    /// names nothing.
    static std::optional<Quantity>
    given(const Parameters &parameters);

    /// "tip, z".
    const std::string &
    name() const
    {
      return text;
    }

    unsigned int
    body() const;

    /// All components of the displacement or force of which it is one. Throws
    /// InputError where a point lies outside its body. Collective.
    dealii::Tensor<1, dim>
    all_components(const Bodies                    &bodies,
                   const std::vector<BodySolution> &solutions,
                   const BoundaryForces            &forces) const;

    /// Which of them it is.
    unsigned int
    component_number() const
    {
      return component;
    }

    double
    value(const Bodies &bodies, const ExactSolution &exact) const;

    /// The derivative by what is solved for. Throws InputError where a
    /// point lies outside. Collective.
    LinearFunctional
    derivative(const Discretisation &discretisation) const;

  private:
    Quantity(const Parameters &parameters, const std::string &name);

    [[noreturn]] void
    fail_outside(const Bodies &bodies) const;

    const Parameters *parameters;
    std::string       text;
    unsigned int      component = 0;

    std::variant<PointQuantity, ResultantQuantity> quantity;
  };

  /// What a quantity is in one cycle.
  struct DualSolution
  {
    double value = 0.;
    double size  = 0.; ///< of all components of the quantity
    /// By body; less the function that the quantity is the energy product with,
    /// see LinearFunctional.
    std::vector<BodySolution> solutions;
    SolveReport               report;
  };

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
