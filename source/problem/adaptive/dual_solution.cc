#include <deal.II/base/mpi.h>

#include <mortise/base/quotes.h>
#include <mortise/problem/adaptive/dual_solution.h>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    [[noreturn]] void
    fail_outside(const Quantity &quantity, const Body &body)
    {
      quantity.parameters->fail("Adaptivity/Quantity",
                                in_quotes(quantity.name) +
                                  ", whose point lies outside of body " +
                                  in_quotes(body.name),
                                "a point of Output/Points in its body");
    }
  } // namespace

  Tensor<1, dim>
  all_components(const Quantity                  &quantity,
                 const Bodies                    &bodies,
                 const std::vector<BodySolution> &solutions,
                 const BoundaryForces            &forces)
  {
    const Body &body = *bodies[quantity.body()];
    if (const auto *force = std::get_if<ResultantQuantity>(&quantity.of))
      return forces.on(body.index, body.boundary_id(force->boundary, ""), {})
        .force;
    const auto value = point_value(body,
                                   solutions[body.index].displacement,
                                   std::get<PointQuantity>(quantity.of).point);
    if (!value)
      fail_outside(quantity, body);
    return *value;
  }

  double
  exact_value(const Quantity      &quantity,
              const Bodies        &bodies,
              const ExactSolution &exact)
  {
    const Body &body = *bodies[quantity.body()];
    if (const auto *force = std::get_if<ResultantQuantity>(&quantity.of))
      return resultant(
        body, exact, body.boundary_id(force->boundary, ""))[quantity.component];
    return exact.displacement(std::get<PointQuantity>(quantity.of).point,
                              body.index)[quantity.component];
  }

  LinearFunctional
  derivative(const Quantity                  &quantity,
             const Discretisation            &discretisation,
             const std::vector<BodySolution> &solutions)
  {
    const Bodies &bodies = discretisation.bodies();
    const Body   &body   = *bodies[quantity.body()];
    if (const auto *force = std::get_if<ResultantQuantity>(&quantity.of))
      return reaction_functional(discretisation,
                                 solutions,
                                 body.index,
                                 body.boundary_id(force->boundary, ""),
                                 quantity.component);
    const CellFunctionals on_cells =
      point_functional(body,
                       std::get<PointQuantity>(quantity.of).point,
                       quantity.component);
    if (Utilities::MPI::max(on_cells.empty() ? 0 : 1,
                            body.triangulation().get_communicator()) == 0)
      fail_outside(quantity, body);
    return {discretisation.load(body, on_cells).rhs,
            discretisation.linear_system().zero_vector().displacement};
  }

  DualSolution
  solve_dual(const RunContext                &run,
             Discretisation                  &discretisation,
             LinearSolver                    &solver,
             GlobalUnknowns                  &unknowns,
             const Quantity                  &quantity,
             const std::vector<BodySolution> &solutions,
             const BoundaryForces            &forces,
             const std::vector<BodySolution> &start)
  {
    DualSolution         result;
    const Tensor<1, dim> all =
      all_components(quantity, discretisation.bodies(), solutions, forces);
    result.value            = all[quantity.component];
    result.size             = all.norm();
    const auto   functional = derivative(quantity, discretisation, solutions);
    SceneLoad    load{functional.rhs, {}};
    SystemVector z;
    do
      if (start.empty())
        result.report = solver.solve(load.rhs, z);
      else
        {
          z             = discretisation.system_vector(start, load);
          result.report = solver.solve_from(load.rhs, z);
        }
    while (!result.report.converged && discretisation.try_as_indefinite());
    const auto on_motion = [&](const PrescribedValues &prescribed,
                               const Vector           &forces) {
      const auto *point = std::get_if<PointQuantity>(&quantity.of);
      if (point == nullptr)
        return functional.lift * forces;
      const SystemVector zero = discretisation.linear_system().zero_vector();
      const Body        &body = *discretisation.bodies()[quantity.body()];
      return (*point_value(body,
                           discretisation
                             .solutions({zero, prescribed}, zero)[body.index]
                             .displacement,
                           point->point))[quantity.component];
    };
    unknowns.release(unknowns.on_motions(on_motion), load, z, result.report);
    z.displacement -= functional.lift;
    result.solutions = discretisation.solutions(load, z);
    run.timers.add("dual", result.report.solve_seconds);
    run.log.stage_line("dual",
                       result.report.solve_seconds,
                       std::to_string(result.report.iterations) +
                         " iterations, residual " +
                         RunLog::number(result.report.relative_residual));
    return result;
  }
} // namespace mortise
