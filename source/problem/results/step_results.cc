#include <deal.II/base/mpi.h>

#include <mortise/adapt/residuals.h>
#include <mortise/output/extremes.h>
#include <mortise/output/functionals.h>
#include <mortise/problem/results/contact_results.h>
#include <mortise/problem/results/step_results.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mortise
{
  using namespace dealii;

  std::vector<InterfaceResidual>
  interface_residuals(const StepEvaluation &step)
  {
    const Bodies  &bodies     = step.discretisation.bodies();
    const Pairing &interfaces = step.discretisation.interfaces();
    std::vector<InterfaceResidual> result;
    for (unsigned int i = 0; i < interfaces.all().size(); ++i)
      {
        const InterfaceParameters &given     = interfaces.sides()[i];
        const InterfaceEvaluation &broken    = step.evaluation_of(i);
        const InterfaceHandler    &interface = *interfaces.all()[i].interface;
        const auto                &cells     = interface.slave().cells;
        InterfaceResidual of{given.name, 0., given.slave.body, {}, {}, {}};
        of.of_cells.resize(bodies[of.body]->triangulation().n_active_cells(),
                           0.);
        for (unsigned int s = 0; s < cells.size(); ++s)
          of.of_cells[cells[s]->active_cell_index()] += broken.energies[s];
        of.size             = std::sqrt(Utilities::MPI::sum(
          std::accumulate(broken.energies.begin(), broken.energies.end(), 0.),
          step.run.comm));
        const auto add_edge = [&](const unsigned int       body,
                                  const BodySurface       &surface,
                                  const std::vector<bool> &at_edge) {
          for (unsigned int k = 0; k < at_edge.size(); ++k)
            if (at_edge[k])
              of.at_contact_edge.emplace_back(
                body, surface.cells[k]->active_cell_index());
        };
        add_edge(given.slave.body, interface.slave(), broken.slave_at_edge);
        add_edge(given.master.body, interface.master(), broken.master_at_edge);
        of.tractions.emplace_back(given.slave.body, broken.on_slave);
        if (!given.is_support)
          of.tractions.emplace_back(given.master.body, broken.on_master);
        result.push_back(std::move(of));
      }
    return result;
  }

  Residuals
  residuals(const StepEvaluation                 &step,
            const std::vector<InterfaceResidual> &interfaces)
  {
    const SceneData      &given = step.solved.data;
    std::vector<BodyData> data;
    for (const auto &body : step.discretisation.bodies())
      data.push_back({given.loads(*body), given.dirichlet(*body), {}});
    for (const InterfaceResidual &of : interfaces)
      for (const auto &[body, tractions] : of.tractions)
        data[body].interfaces.push_back(&tractions);
    return residuals(step.discretisation.bodies(), step.solutions(), data);
  }

  namespace
  {
    ErrorSummary
    errors_of(const StepEvaluation &step, const ExactSolution &exact)
    {
      const Bodies        &bodies     = step.discretisation.bodies();
      const Pairing       &interfaces = step.discretisation.interfaces();
      const SolutionErrors errors =
        solution_errors(bodies, step.solutions(), exact);
      ErrorSummary result;
      result.displacement_l2 = errors.displacement_l2;
      result.displacement_h1 = errors.displacement_h1;
      result.energy          = errors.energy;
      if (step.discretisation.linear_system().mixed())
        result.pressure_l2 = errors.pressure_l2;
      if (interfaces.all().empty())
        return result;
      std::vector<TiedBodies> tied;
      for (unsigned int i = 0; i < interfaces.all().size(); ++i)
        tied.push_back(
          {interfaces.sides()[i].slave.body, interfaces.given_slave(i)});
      result.multiplier_l2 = multiplier_error(
        bodies, interfaces.all(), tied, step.tractions(), exact);
      return result;
    }

  } // namespace

  void
  evaluate_step(const StepEvaluation &step, StepSummary &summary)
  {
    const Bodies           &bodies     = step.discretisation.bodies();
    const auto             &interfaces = step.discretisation.interfaces().all();
    const OutputParameters &asked      = step.run.parameters.output;
    const auto             &point      = asked.moments_about;
    const Point<dim>        about(point[0], point[1], point[2]);
    for (unsigned int b = 0; b < bodies.size(); ++b)
      {
        const Extremes largest = extremes(*bodies[b], step.solutions()[b]);
        summary.bodies[b].displacement_max   = largest.displacement;
        summary.bodies[b].von_mises_max      = largest.von_mises;
        summary.bodies[b].plastic_strain_max = largest.plastic_strain;
      }
    for (unsigned int i = 0; i < interfaces.size(); ++i)
      {
        const Resultants  carried = resultants(interfaces[i],
                                              step.solved.solution.multiplier,
                                              step.run.comm);
        InterfaceSummary &of      = summary.interfaces[i];
        of.force                  = components(carried.force);
        of.moment =
          components(carried.moment + step.forces().moment_of_displacement(i) -
                     cross_product_3d(about, carried.force));
        of.force_residual  = carried.force_residual;
        of.moment_residual = carried.moment_residual;
      }
    add_contact(step, summary);
    if (const auto &exact = step.solved.data.exact())
      summary.errors = errors_of(step, *exact);
    for (const PointQuantity &quantity : asked.points)
      {
        const auto value =
          point_value(*bodies[quantity.body],
                      step.solutions()[quantity.body].displacement,
                      quantity.point);
        summary.quantities.emplace_back(quantity.name,
                                        value ? components(*value) :
                                                std::vector<double>{});
      }
    summary.equilibrium = step.forces().equilibrium();
    for (const ResultantQuantity &quantity : asked.resultants)
      {
        const ForceAndMoment on_boundary =
          step.forces().on(quantity.body,
                           bodies[quantity.body]->boundary_id(quantity.boundary,
                                                              ""),
                           about);
        summary.quantities.emplace_back(quantity.name,
                                        components(on_boundary.force));
        summary.quantities.emplace_back(quantity.name + ", moment",
                                        components(on_boundary.moment));
      }
  }
} // namespace mortise
