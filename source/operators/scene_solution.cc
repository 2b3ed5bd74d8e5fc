#include <mortise/operators/scene_solution.h>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// The ghost values of all but interior dofs, which no other rank's cells
    /// share, are there.
    void
    recover_interiors(const Body                             &body,
                      const CondensedInteriors               &interiors,
                      const std::vector<std::vector<double>> &particular,
                      BodySolution                           &solution)
    {
      if (interiors.n_cells() == 0)
        return;
      BodyVector                          &u    = solution.displacement;
      unsigned int                         next = 0;
      std::vector<types::global_dof_index> dofs, pressures;
      std::vector<double>                  boundary_values;
      for (const auto &cell : body.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned() && cell->get_fe().n_dofs_per_hex() > 0)
          {
            dofs.resize(cell->get_fe().n_dofs_per_cell());
            cell->get_dof_indices(dofs);
            const unsigned int n_b = cell->get_fe().get_first_hex_index();
            boundary_values.resize(n_b);
            for (unsigned int i = 0; i < n_b; ++i)
              boundary_values[i] = u(dofs[i]);
            if (body.pressure)
              {
                const auto own = body.pressure->cell(cell);
                pressures.resize(own->get_fe().n_dofs_per_cell());
                own->get_dof_indices(pressures);
                for (const auto dof : pressures)
                  boundary_values.push_back(solution.pressure(dof));
              }
            const auto values =
              interiors.recover(next, boundary_values, particular[next]);
            ++next;
            for (unsigned int i = 0; i < values.size(); ++i)
              u(dofs[n_b + i]) = values[i];
          }
    }

    /// What a rank reads of @p field after its constraints are distributed.
    Vector
    distributed(const SceneField &field,
                const Vector     &values,
                const MPI_Comm    comm)
    {
      Vector all(values), ghosted;
      field.constraints.distribute(all);
      ghosted.reinit(field.numbering.owned(),
                     field.constraints.get_local_lines(),
                     comm);
      ghosted = all;
      return ghosted;
    }

    void
    initialize(const Bodies &bodies, std::vector<BodySolution> &solutions)
    {
      solutions.resize(bodies.size());
      for (const auto &body : bodies)
        {
          const MPI_Comm comm = body->triangulation().get_communicator();
          solutions[body->index].displacement.reinit(
            body->dof_handler.locally_owned_dofs(), body->relevant_dofs, comm);
          if (body->pressure)
            solutions[body->index].pressure.reinit(
              body->pressure->dof_handler.locally_owned_dofs(),
              body->pressure->relevant_dofs,
              comm);
        }
    }

    /// Where K has a matrix.
    void
    set_from_dofs(const Bodies              &bodies,
                  const SceneFields         &fields,
                  const SystemVector        &solution,
                  std::vector<BodySolution> &solutions)
    {
      const MPI_Comm comm = bodies.front()->triangulation().get_communicator();
      const auto     extract = [&](const unsigned int body,
                               const SceneField  &field,
                               const Vector      &values,
                               BodyVector        &to) {
        for (const auto dof : to.locally_owned_elements())
          to(dof) = values(field.numbering(body, dof));
      };
      const Vector u =
        distributed(fields.displacement, solution.displacement, comm);
      Vector p;
      if (fields.pressure.numbering.size() > 0)
        p = distributed(fields.pressure, solution.pressure, comm);
      for (unsigned int b = 0; b < bodies.size(); ++b)
        {
          extract(b, fields.displacement, u, solutions[b].displacement);
          if (bodies[b]->pressure)
            extract(b, fields.pressure, p, solutions[b].pressure);
        }
    }

    /// Where the unknowns are values at nodes.
    void
    set_from_nodes(const NodalSystem         &nodal,
                   const SystemVector        &solution,
                   std::vector<BodySolution> &solutions)
    {
      const auto set = [](BodyVector                   &vector,
                          const types::global_dof_index dof,
                          const double                  value) {
        if (vector.in_local_range(dof))
          vector(dof) = value;
      };
      nodal.for_each_coefficient(
        solution.displacement,
        [&](const auto body, const auto dof, const double value) {
          set(solutions[body].displacement, dof, value);
        });
      if (solution.pressure.size() > 0)
        nodal.for_each_pressure_coefficient(
          solution.pressure,
          [&](const auto body, const auto dof, const double value) {
            set(solutions[body].pressure, dof, value);
          });
    }
  } // namespace

  std::vector<BodySolution>
  body_solutions(const Bodies                     &bodies,
                 const std::vector<AssembledBody> &assembled,
                 const SceneFields                &fields,
                 const BlockSystem                &system,
                 const SceneLoad                  &load,
                 const SystemVector               &solution)
  {
    std::vector<BodySolution> result;
    initialize(bodies, result);
    if (system.nodal)
      set_from_nodes(*system.nodal, solution, result);
    else
      set_from_dofs(bodies, fields, solution, result);
    const auto &numbering = fields.displacement.numbering;
    for (const auto &body : bodies)
      {
        BodyVector &u = result[body->index].displacement,
                   &p = result[body->index].pressure;
        if (!load.prescribed.empty())
          for (const auto dof : u.locally_owned_elements())
            u(dof) +=
              prescribed_value(load.prescribed, numbering(body->index, dof));
        u.update_ghost_values();
        if (body->pressure)
          p.update_ghost_values();
        if (system.nodal)
          continue;
        recover_interiors(*body,
                          assembled[body->index].interiors,
                          load.interiors[body->index],
                          result[body->index]);
        u.update_ghost_values();
      }
    return result;
  }

  SystemVector
  system_vector(const Bodies                    &bodies,
                const SceneFields               &fields,
                const BlockSystem               &system,
                const PrescribedValues          &prescribed,
                const std::vector<BodySolution> &solutions)
  {
    SystemVector x = system.zero_vector();
    if (system.nodal)
      {
        system.nodal->set_displacement(
          [&](const auto body, const auto dof) {
            return solutions[body].displacement(dof) -
                   prescribed_value(prescribed,
                                    fields.displacement.numbering(body, dof));
          },
          x.displacement);
        if (system.mixed())
          system.nodal->set_pressure(
            [&](const auto body, const auto dof) {
              return solutions[body].pressure(dof);
            },
            x.pressure);
        return x;
      }
    const auto insert = [](const unsigned int body,
                           const BodyVector  &from,
                           const SceneField  &field,
                           Vector            &to) {
      for (const auto dof : from.locally_owned_elements())
        if (const auto index = field.numbering(body, dof);
            !field.constraints.is_constrained(index))
          to[index] = from(dof);
    };
    for (const auto &body : bodies)
      {
        const BodySolution &own = solutions[body->index];
        insert(body->index,
               own.displacement,
               fields.displacement,
               x.displacement);
        if (body->pressure)
          insert(body->index, own.pressure, fields.pressure, x.pressure);
        // interiors were eliminated
        for (const auto &cell : body->dof_handler.active_cell_iterators())
          if (cell->is_locally_owned())
            {
              const auto dofs =
                scene_dofs(body->index, cell, fields.displacement.numbering);
              for (unsigned int i = cell->get_fe().get_first_hex_index();
                   i < dofs.size();
                   ++i)
                x.displacement[dofs[i]] = 0.;
            }
      }
    x.displacement.compress(VectorOperation::insert);
    if (system.mixed())
      x.pressure.compress(VectorOperation::insert);
    return x;
  }
} // namespace mortise
