#include <deal.II/base/mpi.h>

#include <mortise/operators/scene_system.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  AffineConstraints<double>
  scene_constraints(
    const FieldNumbering                         &numbering,
    const std::vector<AffineConstraints<double>> &body_constraints)
  {
    IndexSet lines(numbering.size());
    for (unsigned int b = 0; b < body_constraints.size(); ++b)
      numbering.add_to(b, body_constraints[b].get_local_lines(), lines);
    lines.compress();

    AffineConstraints<double> constraints(lines);
    for (unsigned int b = 0; b < body_constraints.size(); ++b)
      for (const auto &line : body_constraints[b].get_lines())
        {
          const auto dof = numbering(b, line.index);
          constraints.add_line(dof);
          for (const auto &entry : line.entries)
            constraints.add_entry(dof, numbering(b, entry.first), entry.second);
          constraints.set_inhomogeneity(dof, line.inhomogeneity);
        }
    constraints.close();
    return constraints;
  }

  SceneField
  pressure_field(const Bodies &bodies, const MPI_Comm comm)
  {
    std::vector<const DoFHandler<dim> *>   handlers;
    std::vector<AffineConstraints<double>> constraints(bodies.size());
    for (const auto &body : bodies)
      {
        handlers.push_back(body->pressure ? &body->pressure->dof_handler :
                                            nullptr);
        if (body->pressure)
          constraints[body->index].copy_from(body->pressure->conformity);
      }
    SceneField field;
    field.numbering   = FieldNumbering(handlers, comm);
    field.constraints = scene_constraints(field.numbering, constraints);
    return field;
  }

  std::vector<CondensedInteriors>
  assemble_bodies(const Bodies             &bodies,
                  const std::vector<Loads> &loads,
                  const SceneField         &displacement,
                  const SceneField         &pressure,
                  BlockSystem              &system)
  {
    const IndexSet &owned = displacement.numbering.owned();
    {
      // rows of all dofs that the cells of this rank touch
      DynamicSparsityPattern sparsity(
        owned.size(), owned.size(), displacement.constraints.get_local_lines());
      for (const auto &body : bodies)
        add_cell_couplings(*body,
                           displacement.numbering,
                           displacement.constraints,
                           sparsity);
      system.stiffness.reinit(
        owned, owned, sparsity, system.communicator, true);
    }
    system.load.reinit(owned, system.communicator);
    std::vector<const Body *> mixed;
    for (const auto &body : bodies)
      if (body->pressure)
        mixed.push_back(body.get());
    std::unique_ptr<PressureScatter> pressures;
    if (!mixed.empty())
      pressures = std::make_unique<PressureScatter>(mixed,
                                                    displacement,
                                                    pressure,
                                                    system);
    std::vector<CondensedInteriors> interiors;
    for (const auto &body : bodies)
      interiors.push_back(assemble_elasticity(*body,
                                              loads[body->index],
                                              displacement.numbering,
                                              displacement.constraints,
                                              system.stiffness,
                                              system.load,
                                              pressures.get()));
    system.stiffness.compress(VectorOperation::add);
    system.load.compress(VectorOperation::add);
    if (pressures)
      pressures->compress();
    return interiors;
  }

  namespace
  {
    /// The ghost values of all but interior dofs, which no other rank's cells
    /// share, are there.
    void
    recover_interiors(const Body               &body,
                      const CondensedInteriors &interiors,
                      BodySolution             &solution)
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
            const auto values = interiors.recover(next++, boundary_values);
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

    /// @p vector gets the values of one body, in place: a copy would lose the
    /// ghost values.
    void
    extract(const unsigned int     body,
            const DoFHandler<dim> &handler,
            const IndexSet        &relevant,
            const FieldNumbering  &numbering,
            const Vector          &ghosted,
            BodyVector            &vector)
    {
      vector.reinit(handler.locally_owned_dofs(),
                    relevant,
                    handler.get_communicator());
      for (const auto dof : handler.locally_owned_dofs())
        vector(dof) = ghosted(numbering(body, dof));
      vector.update_ghost_values();
    }
  } // namespace

  std::vector<BodySolution>
  body_solutions(const Bodies                          &bodies,
                 const SceneField                      &displacement,
                 const SceneField                      &pressure,
                 const std::vector<CondensedInteriors> &interiors,
                 const SystemSolution                  &solution)
  {
    const MPI_Comm comm = bodies.front()->triangulation().get_communicator();
    const Vector   u = distributed(displacement, solution.displacement, comm);
    Vector         p;
    if (pressure.numbering.size() > 0)
      p = distributed(pressure, solution.pressure, comm);
    std::vector<BodySolution> result(bodies.size());
    for (const auto &body : bodies)
      {
        BodySolution &own = result[body->index];
        extract(body->index,
                body->dof_handler,
                body->relevant_dofs,
                displacement.numbering,
                u,
                own.displacement);
        if (body->pressure)
          extract(body->index,
                  body->pressure->dof_handler,
                  body->pressure->relevant_dofs,
                  pressure.numbering,
                  p,
                  own.pressure);
        recover_interiors(*body, interiors[body->index], own);
        own.displacement.update_ghost_values();
      }
    return result;
  }

  std::vector<BodySolution>
  body_solutions(const Bodies         &bodies,
                 const SceneField     &displacement,
                 const SceneField     &pressure,
                 const NodalSystem    &nodal,
                 const SystemSolution &solution)
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
    nodal.for_each_coefficient(
      solution.displacement,
      [&](const unsigned int            body,
          const types::global_dof_index dof,
          const double                  value) {
        BodyVector &u = result[body].displacement;
        if (!u.in_local_range(dof))
          return;
        const auto index = displacement.numbering(body, dof);
        // one that hangs has both
        u(dof) = value + displacement.constraints.get_inhomogeneity(index);
      });
    if (pressure.numbering.size() > 0)
      nodal.for_each_pressure_coefficient(solution.pressure,
                                          [&](const unsigned int body,
                                              const types::global_dof_index dof,
                                              const double value) {
                                            BodyVector &p =
                                              result[body].pressure;
                                            if (p.in_local_range(dof))
                                              p(dof) = value;
                                          });
    for (BodySolution &own : result)
      {
        own.displacement.update_ghost_values();
        if (own.pressure.size() > 0)
          own.pressure.update_ghost_values();
      }
    return result;
  }

  namespace
  {
    /// Collects blocks of owned dofs, each dof once.
    class BlockCollector
    {
    public:
      BlockCollector(const IndexSet &owned)
        : owned(owned)
        , seen(owned.n_elements(), false)
      {}

      /// The owned ones among @p dofs that no earlier block has.
      std::vector<types::global_dof_index>
      take(const std::vector<types::global_dof_index> &dofs,
           const unsigned int                          begin,
           const unsigned int                          end)
      {
        std::vector<types::global_dof_index> block;
        for (unsigned int i = begin; i < end; ++i)
          if (owned.is_element(dofs[i]) &&
              !seen[owned.index_within_set(dofs[i])])
            {
              seen[owned.index_within_set(dofs[i])] = true;
              block.push_back(dofs[i]);
            }
        return block;
      }

    private:
      const IndexSet   &owned;
      std::vector<bool> seen;
    };
  } // namespace

  void
  describe_structure(const Bodies         &bodies,
                     const FieldNumbering &numbering,
                     BlockSystem          &system)
  {
    BlockCollector                       collector(numbering.owned());
    std::vector<types::global_dof_index> dofs;
    for (const auto &body : bodies)
      for (const auto &cell : body->dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            const auto &fe = cell->get_fe();
            dofs.resize(fe.n_dofs_per_cell());
            cell->get_dof_indices(dofs);
            for (auto &dof : dofs)
              dof = numbering(body->index, dof);

            system.max_degree = std::max(system.max_degree, body->degree(cell));
            const auto take   = [&](const unsigned int begin,
                                  const unsigned int n) {
              auto block = collector.take(dofs, begin, begin + n);
              if (!block.empty())
                system.entity_blocks.push_back(block);
              return block;
            };
            for (const unsigned int v : cell->vertex_indices())
              {
                const auto block = take(dim * v, dim);
                Assert(block.empty() || block.size() == dim,
                       ExcInternalError());
                if (block.empty())
                  continue;
                system.vertex_dofs.insert(system.vertex_dofs.end(),
                                          block.begin(),
                                          block.end());
                system.vertex_points.push_back(cell->vertex(v));
              }
            for (const unsigned int l : cell->line_indices())
              take(fe.get_first_line_index() + l * fe.n_dofs_per_line(),
                   fe.n_dofs_per_line());
            for (const unsigned int f : cell->face_indices())
              take(fe.get_first_quad_index(f), fe.n_dofs_per_quad(f));
          }
    system.max_degree =
      Utilities::MPI::max(system.max_degree, system.communicator);
  }
} // namespace mortise
