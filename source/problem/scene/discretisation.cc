#include <mortise/base/error.h>
#include <mortise/operators/body_volume.h>
#include <mortise/operators/follower_pressures.h>
#include <mortise/problem/input/periodic_cell.h>
#include <mortise/problem/scene/discretisation.h>
#include <mortise/problem/support/rigid_motions.h>
#include <mortise/solvers/multipliers/redundant_multipliers.h>
#include <mortise/solvers/scaled_residual.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace mortise
{
  using namespace dealii;

  Discretisation::Discretisation(const RunContext &run,
                                 const SceneData  &data,
                                 Bodies           &bodies,
                                 const CyclePlan  &cycle)
    : run(run)
    , silent(nowhere, run.comm)
    , quiet{run.parameters, silent, run.timers, run.comm}
    , spaces(bodies, cycle)
  {
    create_spaces(run, data, spaces);
    for (const auto &body : bodies)
      volumes.push_back(body_volume(*body));
    system.communicator       = run.comm;
    system.owned_displacement = spaces.owned_displacement();
    if (spaces.fields.pressure.numbering.size() > 0)
      system.owned_pressure = spaces.owned_pressure();
    check_pieces(spaces.bodies,
                 spaces.dirichlet,
                 spaces.rigid_parts,
                 run.parameters.interfaces);
    auto first = std::make_unique<Pairing>(run, spaces);
    create_bulk();
    set_pairing(std::move(first));
    if (system.mixed())
      find_free_pressures();
  }

  void
  Discretisation::create_bulk()
  {
    auto              stage        = run.log.stage(run.timers, "bulk");
    const SceneField &displacement = spaces.fields.displacement;
    const auto       &interfaces   = run.parameters.interfaces;
    const bool        follow =
      std::any_of(interfaces.begin(), interfaces.end(), [](const auto &given) {
        return given.follows_bodies;
      });
    system.bulk =
      std::make_unique<BulkSystem>(spaces.nodal,
                                   spaces.nodal_pressures,
                                   BulkSystem::Scene{displacement.numbering,
                                                     displacement.constraints,
                                                     spaces.choice.method !=
                                                       SolverMethod::direct,
                                                     follow},
                                   run.comm);
    const auto n_levels = system.bulk->levels().size();
    stage.details(std::to_string(n_levels) +
                  (n_levels == 1 ? " level" : " levels"));
  }

  void
  Discretisation::set_pairing(std::unique_ptr<Pairing> made)
  {
    pairing                          = std::move(made);
    const std::vector<Coupling> &all = pairing->all();
    system.owned_multiplier          = pairing->owned_multiplier();
    if (all.empty())
      return;
    const auto scope = run.timers.scope("coupling");
    system.active.reset();
    system.directions.reset();
    interface_summaries.clear();
    if (system.owned_multiplier.size() > 0)
      {
        const CouplingPartition partition{system.owned_displacement,
                                          system.owned_multiplier,
                                          run.comm};
        system.constraint =
          assemble_by_node(all, partition, pairing->have_frames());
        system.constraint.constrain(system.bulk->levels().front().constrained);
        if (pairing->have_springs())
          system.spring_compliance = assemble_compliance(all, partition);
      }
    for (unsigned int i = 0; i < all.size(); ++i)
      interface_summaries.push_back(pairing->summary(i));
    system.bulk->couple(all);
  }

  namespace
  {
    /// The bodies that interfaces hold together, group by group.
    std::vector<std::vector<unsigned int>>
    tied_groups(const std::vector<InterfaceParameters> &interfaces,
                const unsigned int                      n_bodies)
    {
      std::vector<unsigned int> group(n_bodies);
      std::iota(group.begin(), group.end(), 0);
      for (const InterfaceParameters &interface : interfaces)
        {
          const unsigned int a = group[interface.slave.body],
                             b = group[interface.master.body];
          std::replace(group.begin(), group.end(), a, b);
        }
      std::vector<std::vector<unsigned int>> result(group.size());
      for (unsigned int b = 0; b < group.size(); ++b)
        result[group[b]].push_back(b);
      result.erase(std::remove_if(result.begin(),
                                  result.end(),
                                  [](const auto &list) {
                                    return list.empty();
                                  }),
                   result.end());
      return result;
    }
  } // namespace

  void
  Discretisation::find_free_pressures()
  {
    const Bodies &bodies = spaces.bodies;
    for (const auto &group : tied_groups(pairing->sides(), bodies.size()))
      {
        if (!std::all_of(group.begin(), group.end(), [&](const auto b) {
              return bodies[b]->material.mixed() &&
                     bodies[b]->material.incompressible();
            }))
          continue;
        const Vector        zero = system.zero_vector().pressure;
        Vector              all(zero);
        std::vector<Vector> ones;
        std::string         names;
        for (const unsigned int b : group)
          {
            ones.emplace_back(zero);
            system.bulk->set_constant_pressure(*bodies[b], ones.back());
            all += ones.back();
            names += (names.empty() ? "" : ", ") + bodies[b]->name;
          }
        const Enclosure enclosure = test_enclosure(system, all);
        if (!enclosure.enclosed)
          continue;
        Vector integrals(zero);
        for (unsigned int i = 0; i < group.size(); ++i)
          {
            Vector of_body(integrals);
            system.bulk->apply_pressure_mass(of_body, ones[i]);
            integrals.add(1. / bodies[group[i]]->material.pressure_norm(),
                          of_body);
          }
        system.free_pressures.add(all, integrals);
        free_pressures.push_back({enclosure, names});
      }
  }

  PrescribedValues
  Discretisation::lift(const RigidPart &part, const AffineField &field) const
  {
    return prescribed_values(spaces, part, field);
  }

  Vector
  Discretisation::at_nodes(const PrescribedValues &prescribed) const
  {
    const auto &numbering = spaces.fields.displacement.numbering;
    return system.bulk->values_at_nodes([&](const auto body, const auto dof) {
      return prescribed_value(prescribed, numbering(body, dof));
    });
  }

  std::vector<SystemVector>
  Discretisation::free_states() const
  {
    std::vector<SystemVector> result;
    for (const FreePressure &free : free_pressures)
      result.push_back(free.enclosure.state);
    return result;
  }

  void
  Discretisation::lift(SceneLoad &load) const
  {
    Vector values = at_nodes(load.prescribed);
    if (system.bulk->is_nonlinear())
      load.prescribed_at_nodes = std::move(values);
    else
      {
        system.apply_to_constrained(values, load.rhs);
        scale(load.rhs, -1.);
      }
  }

  SceneLoad
  Discretisation::load(const SceneData &data) const
  {
    const auto         scope = run.timers.scope("bulk");
    std::vector<Loads> loads;
    for (const auto &body : spaces.bodies)
      loads.push_back(data.loads(*body));
    SceneLoad load{system.zero_vector(), prescribed_values(spaces, data)};
    for (const Loads &of_body : loads)
      load.thermal_strains.push_back(of_body.thermal_strain);
    // the points of nonlinear laws know them, others have an equivalent load
    load.thermal_strains_at_points =
      system.bulk->thermal_strains(load.thermal_strains);
    for (const auto &body : spaces.bodies)
      if (body->material.nonlinear())
        loads[body->index].thermal_strain = {};
    if (spaces.has_prescribed_values() || system.bulk->is_nonlinear())
      lift(load);
    system.bulk->add_loads(loads, load);
    if (std::any_of(loads.begin(), loads.end(), [](const Loads &of_body) {
          return !of_body.follower_pressures.empty();
        }))
      load.follower_pressures =
        std::make_shared<const FollowerPressures>(system.bulk->levels().front(),
                                                  loads);
    add_gaps(data, load);
    for (const FreePressure &free : free_pressures)
      {
        if (const double flux = free.enclosure.flux(load.rhs); flux > 0.01)
          throw InputError(
            "Body " + free.bodies +
            ": the displacements prescribed all around change the volume (" +
            RunLog::number(100. * flux) +
            " % of what flows in and out does not cancel), and Poisson ratio "
            "0.5 lets no volume change; allowed: displacements that keep it, "
            "a boundary that is free, or a smaller ratio");
        if (!has_free_volume(run.parameters)) // else Mean stress gives it
          run.log.warning(
            "body " + free.bodies +
            ": incompressible and enclosed, so that a constant pressure has no effect; the mean pressure is set to zero");
      }
    if (system.mixed())
      system.free_pressures.project_residual(load.rhs.pressure);
    return load;
  }

  void
  Discretisation::add_gaps(const SceneData &data, SceneLoad &load) const
  {
    Vector &gaps = load.rhs.multiplier;
    if (gaps.size() == 0)
      return;
    if (load.prescribed_at_nodes.size() > 0)
      {
        Vector closed(gaps);
        system.constraint.vmult_free(closed, load.prescribed_at_nodes);
        gaps -= closed;
      }
    for (unsigned int i = 0; i < pairing->all().size(); ++i)
      if (const auto offset = data.offset(pairing->sides()[i]))
        add_offset(pairing->all()[i], offset, gaps);
    add_mesh_gaps(gaps);
  }

  void
  Discretisation::set_gaps(const SceneData &data, SceneLoad &load) const
  {
    load.rhs.multiplier = system.zero_vector().multiplier;
    add_gaps(data, load);
  }

  SceneLoad
  Discretisation::load(const Body            &body,
                       const CellFunctionals &functionals) const
  {
    SceneLoad load{system.zero_vector(), {}};
    system.bulk->assemble_functional(body, functionals, load.rhs);
    if (system.mixed())
      system.free_pressures.project_residual(load.rhs.pressure);
    return load;
  }

  std::vector<BodySolution>
  Discretisation::solutions(const SceneLoad    &load,
                            const SystemVector &solution) const
  {
    return body_solutions(spaces.bodies, spaces.fields, system, load, solution);
  }

  Vector
  Discretisation::prescribed_vector(const SceneLoad &load) const
  {
    const IndexSet &owned = spaces.fields.displacement.numbering.owned();
    Vector          result(owned, run.comm);
    for (const auto &[dof, value] : load.prescribed)
      if (owned.is_element(dof))
        result[dof] = value;
    return result;
  }

  TraceDisplacement
  Discretisation::trace_displacement(
    const SceneLoad                 &load,
    const std::vector<BodySolution> &solutions) const
  {
    const auto &numbering = spaces.fields.displacement.numbering;
    Vector      all(numbering.owned(), run.comm);
    for (unsigned int b = 0; b < solutions.size(); ++b)
      for (const auto dof : solutions[b].displacement.locally_owned_elements())
        all[numbering(b, dof)] = solutions[b].displacement(dof);
    return {std::move(all), prescribed_vector(load)};
  }

  SystemVector
  Discretisation::system_vector(const std::vector<BodySolution> &solutions,
                                const SceneLoad                 &load) const
  {
    return mortise::system_vector(spaces.fields,
                                  system,
                                  load.prescribed,
                                  solutions);
  }

  SystemVector
  Discretisation::system_vector(const SceneValues &values,
                                const SceneLoad   &load) const
  {
    SystemVector x = system_vector(values.solutions, load);
    for (unsigned int i = 0; i < pairing->all().size(); ++i)
      set_multiplier(pairing->all()[i], values.multipliers[i], x.multiplier);
    return x;
  }

  void
  Discretisation::check_multipliers() const
  {
    if (pairing->all().size() < 2)
      return; // those of one interface are independent by their rules
    if (system.owned_multiplier.size() == 0)
      return;
    const ScaledResidual residual(system);
    const auto           dependent =
      find_redundant_multipliers(system.constraint,
                                 residual.inverse_diagonal_u(),
                                 residual.inverse_diagonal_lambda(),
                                 system.spring_compliance);
    if (!dependent.empty())
      throw InputError(
        "Interfaces tie the same displacements more than once, so that tractions "
        "are not determined; multipliers that depend on others: " +
        pairing->count_by_name(dependent) +
        ". Drop one of the interfaces that meet there, or exchange slave and "
        "master of one");
  }

  StepSummary
  Discretisation::summary() const
  {
    StepSummary step;
    for (const auto &body : spaces.bodies)
      {
        const auto                statistics = body->statistics();
        const MaterialParameters &material =
          run.parameters.bodies[body->index].material;
        const double volume = volumes[body->index];
        step.bodies.push_back(
          {body->name,
           body->mesh.tetrahedra ? "tetrahedra" : "hexahedra",
           statistics.cells,
           statistics.degree_min,
           statistics.degree_max,
           body->dof_handler.n_dofs(),
           material.law,
           volume,
           material.density > 0. ?
             std::optional<double>(material.density * volume) :
             std::nullopt,
           {},
           {},
           {}});
      }
    const auto n_pressures = spaces.fields.pressure.numbering.size();
    step.dofs.displacement = spaces.fields.displacement.numbering.size();
    step.dofs.total        = step.dofs.displacement + n_pressures;
    if (n_pressures > 0)
      step.dofs.pressure = n_pressures;
    if (!pairing->all().empty())
      {
        step.dofs.multiplier = system.owned_multiplier.size();
        step.dofs.total += system.owned_multiplier.size();
      }
    step.interfaces = interface_summaries;
    return step;
  }
} // namespace mortise
