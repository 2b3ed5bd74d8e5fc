#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/body/boundary_faces.h>
#include <mortise/problem/formulation.h>
#include <mortise/problem/result_checks.h>
#include <mortise/problem/rigid_motions.h>
#include <mortise/problem/scene_data.h>
#include <mortise/problem/simulation.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>

namespace mortise
{
  using namespace dealii;

  Simulation::Simulation(const Parameters &parameters,
                         RunLog           &log,
                         const MPI_Comm    comm)
    : parameters(parameters)
    , log(log)
    , comm(comm)
    , interfaces(parameters.interfaces)
  {
    summary.program = program_info(Utilities::MPI::n_mpi_processes(comm));
    summary.title   = parameters.title;
    summary.steps.resize(1);
    system.communicator = comm;
  }

  void
  Simulation::create_meshes()
  {
    auto stage = log.stage(timers, "mesh");
    exact      = make_exact_solution(parameters, field_checks);
    std::vector<std::vector<std::string>> boundary_names;
    std::vector<std::set<std::string>>    tied_boundaries(
      parameters.bodies.size());
    for (const InterfaceParameters &interface : parameters.interfaces)
      for (const SideParameters &side : {interface.slave, interface.master})
        tied_boundaries[side.body].insert(side.boundary);
    std::uint64_t n_cells = 0;
    for (unsigned int b = 0; b < parameters.bodies.size(); ++b)
      {
        const BodyParameters &body = parameters.bodies[b];
        bodies.push_back(
          std::make_unique<Body>(body.name, b, materials(parameters)[b]));
        bodies[b]->create_mesh(body.mesh,
                               comm,
                               "Body " + body.name + ", Mesh",
                               tied_boundaries[b]);
        n_cells += bodies[b]->triangulation().n_global_active_cells();
        boundary_names.emplace_back();
        for (const auto &name : bodies[b]->mesh.names.boundaries)
          boundary_names.back().push_back(name.first);
      }
    check_boundary_names(parameters, boundary_names);
    stage.details(std::to_string(bodies.size()) +
                  (bodies.size() == 1 ? " body, " : " bodies, ") +
                  std::to_string(n_cells) + " cells");
  }

  void
  Simulation::create_spaces()
  {
    auto stage = log.stage(timers, "spaces");

    std::vector<const DoFHandler<dim> *> handlers;
    for (const auto &body : bodies)
      {
        const BodyParameters &given = parameters.bodies[body->index];
        body->create_space(given.degree,
                           given.degree_by_region,
                           "Body " + body->name);
        handlers.push_back(&body->dof_handler);
        if (locks(given))
          log.warning("body " + body->name + " with Poisson ratio " +
                      RunLog::number(given.material.poisson_ratio) +
                      " and degree 1 is too stiff (it locks); a higher Degree "
                      "gives it a pressure of its own");
        dirichlet.push_back(
          make_dirichlet(parameters, *body, exact, field_checks));
      }
    for (const auto &body : bodies)
      {
        body_constraints.emplace_back();
        body_constraints.back().copy_from(body->conformity);
        add_dirichlet_constraints(*body,
                                  dirichlet[body->index],
                                  body_constraints.back());
      }
    auto &numbering = displacement_field.numbering;
    numbering       = FieldNumbering(handlers, comm);
    displacement_field.constraints =
      scene_constraints(numbering, body_constraints);
    system.owned_displacement = numbering.owned();
    pressure_field            = mortise::pressure_field(bodies, comm);
    const auto n_pressures    = pressure_field.numbering.size();
    if (n_pressures > 0)
      system.owned_pressure = pressure_field.numbering.owned();

    StepSummary &step = summary.steps.back();
    for (const auto &body : bodies)
      {
        const auto statistics = body->statistics();
        step.bodies.push_back(
          {body->name,
           body->mesh.tetrahedra ? "tetrahedra" : "hexahedra",
           statistics.cells,
           statistics.degree_min,
           statistics.degree_max,
           body->dof_handler.n_dofs()});
      }
    unsigned int max_degree = 1;
    for (const BodySummary &body : step.bodies)
      max_degree = std::max(max_degree, body.degree_max);
    choose_method(max_degree);

    step.dofs.displacement = numbering.size();
    step.dofs.total        = numbering.size() + n_pressures;
    if (n_pressures > 0)
      step.dofs.pressure = n_pressures;
    stage.details(std::to_string(numbering.size()) + " displacement dofs" +
                  (n_pressures > 0 ?
                     ", " + std::to_string(n_pressures) + " pressures" :
                     ""));
  }

  void
  Simulation::choose_method(const unsigned int max_degree)
  {
    std::vector<const Body *> scene;
    for (const auto &body : bodies)
      scene.push_back(body.get());
    const bool nodal = NodalSpace::represents(scene);
    double     softest = std::numeric_limits<double>::max(), stiffest = 0.;
    for (const auto &body : bodies)
      {
        softest  = std::min(softest, body->material.softest_modulus());
        stiffest = std::max(stiffest, body->material.stiffest_modulus());
      }
    choice = choose_solver(parameters.solver.method,
                                     {displacement_field.numbering.size(),
                                      max_degree,
                                      nodal,
                            system.mixed(),
                            stiffest / softest});
    if (nodal && choice.method != SolverMethod::direct)
      {
        nodal_spaces = make_nodal_spaces(scene, comm);
        system.owned_displacement =
          displacement_indices(nodal_spaces.front()->owned_nodes());
        if (system.mixed())
          {
            nodal_pressures       = make_nodal_pressures(scene, comm);
            system.owned_pressure = nodal_pressures->owned_nodes();
          }
      }
  }

  Coupling
  Simulation::make_coupling(const InterfaceParameters &given) const
      {
        const auto surface = [&](const SideParameters &side) {
          const Body &body = *bodies[side.body];
          return extract_surface(body,
                                 body.boundary_id(side.boundary,
                                                  "Interface " + given.name),
                                 displacement_field.numbering,
                                 displacement_field.constraints,
                                 nodal_spaces);
        };
        InterfaceOptions options;
        options.search_fraction      = given.search_distance;
        options.points_per_direction = given.quadrature_points;
    Coupling coupling;
    coupling.interface = std::make_unique<InterfaceHandler>(
      given.name, surface(given.slave), surface(given.master), options, comm);
    return coupling;
  }

  void
  Simulation::integrate(Coupling &coupling) const
  {
    coupling.local = integrate_coupling(*coupling.interface,
                                        choice.method != SolverMethod::direct);
  }

  void
  Simulation::find_pairs()
  {
    auto          stage = log.stage(timers, "interface_search");
    std::uint64_t faces = 0;
    for (const InterfaceParameters &given : interfaces)
      {
        couplings.push_back(make_coupling(given));
        faces +=
          Utilities::MPI::sum(couplings.back().interface->slave().faces.size(),
                              comm);
      }
    stage.details(std::to_string(faces) + " slave faces");
  }

  void
  Simulation::couple()
  {
    const auto  total    = timers.scope("coupling");
    double      clipping = 0.;
    std::string balance;
    for (unsigned int i = 0; i < couplings.size(); ++i)
      {
        integrate(couplings[i]);
        const InterfaceReport &report = couplings[i].interface->report();
        clipping += report.clipping_seconds;
        if (const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(comm);
            n_ranks > 1)
          balance +=
            (i ? ", " : "") + std::to_string(report.largest_integration_cells) +
            " cells on the busiest rank, " +
            RunLog::number(double(report.integration_cells) / n_ranks) +
            " on average";
        if (report.coinciding_faces > 0)
          balance += (balance.empty() ? "" : ", ") +
                     std::to_string(report.coinciding_faces) + " of " +
                     std::to_string(report.slave_faces) +
                     " faces coincide with a partner";
        if (report.pairs == 0)
          {
            const InterfaceParameters &given = interfaces[i];
            throw InputError(
              "Interface " + given.name + ": the surfaces " +
              bodies[given.slave.body]->name + ": " + given.slave.boundary +
              " and " + bodies[given.master.body]->name + ": " +
              given.master.boundary +
              " do not meet: no pair of faces overlaps within the search distance of " +
              RunLog::number(given.search_distance) +
              " face sizes. Check positions, names and Search distance");
          }
        if (report.failed_pairs > 0)
          log.warning("interface " + interfaces[i].name +
                      ": the projection of " +
                      std::to_string(report.failed_pairs) +
                      " pairs of faces did not converge");
        if (report.covered_area < 0.999 * report.slave_area)
          {
            std::ostringstream text;
            text
              << "interface " << interfaces[i].name << ": only "
              << RunLog::number(100. * report.covered_area / report.slave_area)
              << " % of the slave surface has a partner; worst is the face at "
              << report.worst_face_centre << " ("
              << RunLog::number(100. * report.worst_face_error) << " % off)";
            log.warning(text.str());
          }
      }
    if (Utilities::MPI::max(clipping, comm) == 0.)
      return; // all faces coincide
    timers.add("interface_clipping", clipping);
    timers.add("coupling", -clipping);
    log.stage_line("interface_clipping",
                   Utilities::MPI::max(clipping, comm),
                   balance);
  }

  void
  Simulation::assemble()
  {
    if (!couplings.empty())
      {
        auto stage = log.stage(timers, "coupling");
        choose_multipliers();
        const CouplingPartition partition{system.owned_displacement,
                                          system.owned_multiplier,
                                          comm};
        if (system.owned_multiplier.size() > 0)
          {
            assemble_constraint(couplings,
                                partition,
                                system.coupling,
                                system.coupling_rhs);
            if (choice.method != SolverMethod::direct && nodal_spaces.empty())
              assemble_jump_penalty(couplings, partition, system.jump_penalty);
          }
        for (unsigned int i = 0; i < couplings.size(); ++i)
          summarise_interface(i);
        stage.details(std::to_string(system.owned_multiplier.size()) +
                      " multipliers");
      }
    else
      {
        system.owned_multiplier.set_size(0);
        check_rigid_motions(bodies, dirichlet, {});
      }
    auto               stage = log.stage(timers, "bulk");
    std::vector<Loads> loads;
    for (const auto &body : bodies)
      loads.push_back(make_loads(parameters, *body, exact, field_checks));
    system.max_degree = 1;
    for (const auto &body : bodies)
      system.max_degree = std::max(system.max_degree, body->max_degree());
    if (!nodal_spaces.empty())
      {
        const NodalSystem::Scene scene{displacement_field.numbering,
                                       displacement_field.constraints,
                                       couplings};
        system.nodal = std::make_unique<NodalSystem>(std::move(nodal_spaces),
                                                     std::move(nodal_pressures),
                                                     scene,
                                                     comm);
        system.nodal->assemble_load(loads,
                                    scene,
                                    system.load,
                                    system.pressure_load);
        if (system.owned_multiplier.size() > 0)
          system.nodal->drop_held_columns(system.coupling);
        stage.details("without a matrix");
        return;
      }
    interiors = assemble_bodies(
      bodies, loads, displacement_field, pressure_field, system);
    describe_structure(bodies, displacement_field.numbering, system);
    stage.details(std::to_string(system.stiffness.n_nonzero_elements()) +
                  " entries");
  }

  void
  Simulation::solve()
  {
    if (system.mixed())
      find_free_pressures();
    SolverOptions options;
    options.method         = choice.method;
    options.tolerance      = parameters.solver.tolerance;
    options.max_iterations = parameters.solver.max_iterations;
    options.max_gathered   = parameters.solver.max_gathered;
    if (parameters.solver.print_iterations)
      options.monitor = [&](const unsigned int iteration,
                            const double       residual) {
        log.line("    iteration " + std::to_string(iteration) + "  residual " +
                 RunLog::number(residual));
      };
    // a factorisation gives one of many answers and does not tell
    if (choice.method == SolverMethod::direct)
      check_multipliers();
    // The answer is linear in the loads: loads of size 1, scaled without
    // rounding, keep the single precision of preconditioners from its limits.
    const double scale = load_scale(system);
    scale_loads(system, scale);
    solve_report = mortise::solve(system, options, solution);
    if (!choice.reason.empty())
      solve_report.preconditioner += "; " + choice.reason;
    scale_loads(system, 1. / scale);
    for (Vector *part :
         {&solution.displacement, &solution.pressure, &solution.multiplier})
      if (part->size() > 0)
        *part *= 1. / scale;
    if (!std::isfinite(solve_report.relative_residual))
      solve_report.converged = false;
    if (!solve_report.converged)
      check_multipliers();

    timers.add("solver_setup", solve_report.setup_seconds);
    timers.add("solve", solve_report.solve_seconds);
    log.stage_line("solver_setup",
                   solve_report.setup_seconds,
                   solve_report.preconditioner);
    log.stage_line("solve",
                   solve_report.solve_seconds,
                   solve_report.method + ", " +
                     std::to_string(solve_report.iterations) +
                     " iterations, residual " +
                     RunLog::number(solve_report.relative_residual) +
                     (solve_report.converged && solve_report.attainable > 0. ?
                        ", all that rounding leaves with moduli and sizes "
                        "this different" :
                        ""));
    SolverSummary result;
    result.method               = solve_report.method;
    result.preconditioner       = solve_report.preconditioner;
    result.iterations           = solve_report.iterations;
    result.relative_residual    = solve_report.relative_residual;
    summary.steps.back().solver = result;
    summary.status = solve_report.converged ? "done" : "not converged";
  }
} // namespace mortise
