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

  StepFields
  step_fields(const RunContext     &run,
              const Discretisation &discretisation,
              const SolvedStep     &solved)
  {
    StepFields fields;
    fields.solutions = discretisation.solutions(solved.load, solved.solution);
    for (const Coupling &coupling : discretisation.interfaces().all())
      {
        const Vector &multiplier = solved.solution.multiplier;
        fields.tractions.push_back(
          multiplier_on_faces(coupling, multiplier, run.comm));
        fields.multipliers.push_back(
          multiplier_coefficients(coupling, multiplier, run.comm));
      }
    const auto &asked = run.parameters.output.fields;
    if (discretisation.interfaces().have_contact() &&
        std::find(asked.begin(), asked.end(), "traction") != asked.end())
      fields.contact = contact_fields(run, discretisation, solved);
    return fields;
  }

  namespace
  {
    /// @p offset, which may be null, and @p shortening.
    std::function<double(const Point<dim> &)>
    offset_with(const std::function<double(const Point<dim> &)> &offset,
                const double                                     shortening)
    {
      if (shortening == 0.)
        return offset;
      return [offset, shortening](const Point<dim> &x) {
        return (offset ? offset(x) : 0.) + shortening;
      };
    }
  } // namespace

  std::vector<InterfaceViolation>
  violations(const RunContext     &run,
             const Discretisation &discretisation,
             const SolvedStep     &solved,
             const StepFields     &fields)
  {
    const Pairing          &interfaces = discretisation.interfaces();
    const TraceDisplacement displacement =
      discretisation.trace_displacement(solved.load, fields.solutions);
    std::vector<InterfaceViolation> result;
    for (unsigned int i = 0; i < interfaces.all().size(); ++i)
      {
        const InterfaceParameters &given = interfaces.sides()[i];
        const Violations           broken =
          violation_energies(interfaces.all()[i],
                             displacement,
                             fields.tractions[i],
                             offset_with(solved.data.offset(given),
                                         solved.shortenings[i]),
                             run.comm);
        const InterfaceHandler &interface = *interfaces.all()[i].interface;
        const auto             &cells     = interface.slave().cells;
        InterfaceViolation of{given.name, 0., given.slave.body, {}, {}, {}};
        of.of_cells.resize(
          discretisation.bodies()[of.body]->triangulation().n_active_cells(),
          0.);
        for (unsigned int s = 0; s < cells.size(); ++s)
          of.of_cells[cells[s]->active_cell_index()] += broken.energies[s];
        of.size             = std::sqrt(Utilities::MPI::sum(
          std::accumulate(broken.energies.begin(), broken.energies.end(), 0.),
          run.comm));
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
  residuals(const Discretisation                  &discretisation,
            const SolvedStep                      &solved,
            const StepFields                      &fields,
            const std::vector<InterfaceViolation> &interfaces)
  {
    std::vector<BodyData> data;
    for (const auto &body : discretisation.bodies())
      data.push_back(
        {solved.data.loads(*body), solved.data.dirichlet(*body), {}});
    for (const InterfaceViolation &of : interfaces)
      for (const auto &[body, tractions] : of.tractions)
        data[body].interfaces.push_back(&tractions);
    return residuals(discretisation.bodies(), fields.solutions, data);
  }

  namespace
  {
    ErrorSummary
    errors_of(const Discretisation &discretisation,
              const ExactSolution  &exact,
              const StepFields     &fields)
    {
      const Bodies        &bodies     = discretisation.bodies();
      const Pairing       &interfaces = discretisation.interfaces();
      const SolutionErrors errors =
        solution_errors(bodies, fields.solutions, exact);
      ErrorSummary result;
      result.displacement_l2 = errors.displacement_l2;
      result.displacement_h1 = errors.displacement_h1;
      result.energy          = errors.energy;
      if (discretisation.linear_system().mixed())
        result.pressure_l2 = errors.pressure_l2;
      if (interfaces.all().empty())
        return result;
      std::vector<TiedBodies> tied;
      for (unsigned int i = 0; i < interfaces.all().size(); ++i)
        tied.push_back(
          {interfaces.sides()[i].slave.body, interfaces.given_slave(i)});
      result.multiplier_l2 = multiplier_error(
        bodies, interfaces.all(), tied, fields.tractions, exact);
      return result;
    }

  } // namespace

  void
  evaluate_step(const RunContext     &run,
                const Discretisation &discretisation,
                const SolvedStep     &solved,
                const StepFields     &fields,
                StepSummary          &summary)
  {
    const Bodies        &bodies     = discretisation.bodies();
    const auto          &interfaces = discretisation.interfaces().all();
    const auto          &point      = run.parameters.output.moments_about;
    const Tensor<1, dim> about({point[0], point[1], point[2]});
    for (unsigned int b = 0; b < bodies.size(); ++b)
      {
        const Extremes largest = extremes(*bodies[b], fields.solutions[b]);
        summary.bodies[b].displacement_max = largest.displacement;
        summary.bodies[b].von_mises_max    = largest.von_mises;
      }
    for (unsigned int i = 0; i < interfaces.size(); ++i)
      {
        const Resultants carried =
          resultants(interfaces[i], solved.solution.multiplier, run.comm);
        InterfaceSummary &of = summary.interfaces[i];
        of.force             = components(carried.force);
        of.moment =
          components(carried.moment - cross_product_3d(about, carried.force));
        of.force_residual  = carried.force_residual;
        of.moment_residual = carried.moment_residual;
      }
    if (discretisation.interfaces().have_contact())
      add_contact(run, discretisation, solved, fields, summary);
    if (const auto &exact = solved.data.exact())
      summary.errors = errors_of(discretisation, *exact, fields);
    for (const PointQuantity &quantity : run.parameters.output.points)
      {
        const auto value =
          point_value(*bodies[quantity.body],
                      fields.solutions[quantity.body].displacement,
                      quantity.point);
        summary.quantities.emplace_back(quantity.name,
                                        value ? components(*value) :
                                                std::vector<double>{});
      }
  }

  void
  add_forces(const RunContext     &run,
             const Bodies         &bodies,
             const BoundaryForces &forces,
             StepSummary          &summary)
  {
    const auto &about   = run.parameters.output.moments_about;
    summary.equilibrium = forces.equilibrium();
    for (const ResultantQuantity &quantity : run.parameters.output.resultants)
      {
        const ForceAndMoment on_boundary =
          forces.on(quantity.body,
                    bodies[quantity.body]->boundary_id(quantity.boundary, ""),
                    Point<dim>(about[0], about[1], about[2]));
        summary.quantities.emplace_back(quantity.name,
                                        components(on_boundary.force));
        summary.quantities.emplace_back(quantity.name + ", moment",
                                        components(on_boundary.moment));
      }
  }
} // namespace mortise
