#include <deal.II/base/mpi.h>

#include <mortise/operators/pressure_scatter.h>
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

  std::vector<AssembledBody>
  assemble_bodies(const Bodies                 &bodies,
                  const std::vector<LoadKinds> &kinds,
                  const SceneField             &displacement,
                  const SceneField             &pressure,
                  BlockSystem                  &system)
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
    std::vector<AssembledBody> assembled;
    for (const auto &body : bodies)
      assembled.push_back(assemble_elasticity(*body,
                                              displacement.numbering,
                                              displacement.constraints,
                                              kinds[body->index],
                                              system.stiffness,
                                              pressures.get()));
    system.stiffness.compress(VectorOperation::add);
    if (pressures)
      pressures->compress();
    return assembled;
  }

  SceneLoad
  assemble_load(const std::vector<Loads>         &loads,
                const PrescribedValues           &prescribed,
                const Bodies                     &bodies,
                const std::vector<AssembledBody> &assembled,
                const SceneFields                &fields,
                const BlockSystem                &system)
  {
    SceneLoad load{system.zero_vector(), prescribed, {}};
    if (system.nodal)
      {
        system.nodal->assemble_load(loads, fields.displacement.numbering, load);
        return load;
      }
    load.interiors.resize(bodies.size());
    for (const auto &body : bodies)
      add_assembled_load(*body,
                         loads[body->index],
                         assembled[body->index],
                         fields.displacement,
                         &fields.pressure,
                         load);
    load.rhs.displacement.compress(VectorOperation::add);
    if (system.mixed())
      load.rhs.pressure.compress(VectorOperation::add);
    return load;
  }

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

    double
    value_of(const types::global_dof_index dof,
             const PrescribedValues       &prescribed)
    {
      const auto found = prescribed.find(dof);
      return found == prescribed.end() ? 0. : found->second;
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
      const auto     extract = [&](const unsigned int    body,
                               const SceneField     &field,
                               const Vector         &values,
                               BodyVector           &to) {
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
            u(dof) += value_of(numbering(body->index, dof), load.prescribed);
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
                   value_of(fields.displacement.numbering(body, dof),
                            prescribed);
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
        insert(
          body->index, own.displacement, fields.displacement, x.displacement);
        if (body->pressure)
          insert(body->index, own.pressure, fields.pressure, x.pressure);
        // interiors were eliminated
        std::vector<types::global_dof_index> dofs;
        for (const auto &cell : body->dof_handler.active_cell_iterators())
          if (cell->is_locally_owned())
            {
              dofs.resize(cell->get_fe().n_dofs_per_cell());
              cell->get_dof_indices(dofs);
              for (unsigned int i = cell->get_fe().get_first_hex_index();
                   i < dofs.size();
                   ++i)
                x.displacement[fields.displacement.numbering(body->index,
                                                             dofs[i])] = 0.;
            }
      }
    x.displacement.compress(VectorOperation::insert);
    if (system.mixed())
      x.pressure.compress(VectorOperation::insert);
    return x;
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
