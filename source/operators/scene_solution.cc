#include <mortise/operators/scene_solution.h>

namespace mortise
{
  using namespace dealii;

  std::vector<BodySolution>
  zero_solutions(const Bodies &bodies)
  {
    std::vector<BodySolution> result(bodies.size());
    for (const auto &body : bodies)
      {
        const MPI_Comm comm = body->triangulation().get_communicator();
        result[body->index].displacement.reinit(
          body->dof_handler.locally_owned_dofs(), body->relevant_dofs, comm);
        if (body->pressure)
          result[body->index].pressure.reinit(
            body->pressure->dof_handler.locally_owned_dofs(),
            body->pressure->relevant_dofs,
            comm);
      }
    return result;
  }

  std::vector<BodySolution>
  body_solutions(const Bodies       &bodies,
                 const SceneFields  &fields,
                 const BlockSystem  &system,
                 const SceneLoad    &load,
                 const SystemVector &solution)
  {
    std::vector<BodySolution> result = zero_solutions(bodies);
    const auto                set    = [](BodyVector                   &vector,
                        const types::global_dof_index dof,
                        const double                  value) {
      if (vector.in_local_range(dof))
        vector(dof) = value;
    };
    system.bulk->for_each_coefficient(
      solution.displacement,
      [&](const auto body, const auto dof, const double value) {
        set(result[body].displacement, dof, value);
      });
    if (solution.pressure.size() > 0)
      system.bulk->for_each_pressure_coefficient(
        solution.pressure,
        [&](const auto body, const auto dof, const double value) {
          set(result[body].pressure, dof, value);
        });
    const auto &numbering = fields.displacement.numbering;
    for (const auto &body : bodies)
      {
        BodyVector &u = result[body->index].displacement;
        if (!load.prescribed.empty())
          for (const auto dof : u.locally_owned_elements())
            u(dof) +=
              prescribed_value(load.prescribed, numbering(body->index, dof));
        u.update_ghost_values();
        if (body->pressure)
          result[body->index].pressure.update_ghost_values();
        if (!load.thermal_strains.empty())
          result[body->index].thermal_strain =
            load.thermal_strains[body->index];
      }
    return result;
  }

  SystemVector
  system_vector(const SceneFields               &fields,
                const BlockSystem               &system,
                const PrescribedValues          &prescribed,
                const std::vector<BodySolution> &solutions)
  {
    SystemVector x = system.zero_vector();
    system.bulk->set_displacement(
      [&](const auto body, const auto dof) {
        return solutions[body].displacement(dof) -
               prescribed_value(prescribed,
                                fields.displacement.numbering(body, dof));
      },
      x.displacement);
    if (system.mixed())
      system.bulk->set_pressure(
        [&](const auto body, const auto dof) {
          return solutions[body].pressure(dof);
        },
        x.pressure);
    return x;
  }
} // namespace mortise
