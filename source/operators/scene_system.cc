#include <deal.II/base/mpi.h>

#include <mortise/operators/scene_system.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  AffineConstraints<double>
  scene_constraints(
    const Bodies                                 &bodies,
    const DisplacementNumbering                  &numbering,
    const std::vector<AffineConstraints<double>> &body_constraints)
  {
    IndexSet lines(numbering.size());
    for (unsigned int b = 0; b < bodies.size(); ++b)
      numbering.add_to(b, bodies[b]->relevant_dofs, lines);
    lines.compress();

    AffineConstraints<double> constraints(lines);
    for (unsigned int b = 0; b < bodies.size(); ++b)
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

  std::vector<CondensedInteriors>
  assemble_bodies(const Bodies                    &bodies,
                  const std::vector<Loads>        &loads,
                  const DisplacementNumbering     &numbering,
                  const AffineConstraints<double> &constraints,
                  BlockSystem                     &system)
  {
    const IndexSet &owned = numbering.owned();
    {
      // rows of all dofs that the cells of this rank touch
      DynamicSparsityPattern sparsity(owned.size(),
                                      owned.size(),
                                      constraints.get_local_lines());
      for (const auto &body : bodies)
        add_cell_couplings(*body, numbering, constraints, sparsity);
      system.stiffness.reinit(
        owned, owned, sparsity, system.communicator, true);
    }
    system.load.reinit(owned, system.communicator);
    std::vector<CondensedInteriors> interiors;
    for (const auto &body : bodies)
      interiors.push_back(assemble_elasticity(*body,
                                              loads[body->index],
                                              numbering,
                                              constraints,
                                              system.stiffness,
                                              system.load));
    system.stiffness.compress(VectorOperation::add);
    system.load.compress(VectorOperation::add);
    return interiors;
  }

  namespace
  {
    /// @p vector has the ghost values of all but interior dofs, which no other rank's cells share.
    void
    recover_interiors(const Body               &body,
                      const CondensedInteriors &interiors,
                      BodyVector               &vector)
    {
      if (interiors.n_cells() == 0)
        return;
      unsigned int                         next = 0;
      std::vector<types::global_dof_index> dofs;
      std::vector<double>                  boundary_values;
      for (const auto &cell : body.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned() && cell->get_fe().n_dofs_per_hex() > 0)
          {
            dofs.resize(cell->get_fe().n_dofs_per_cell());
            cell->get_dof_indices(dofs);
            boundary_values.resize(cell->get_fe().get_first_hex_index());
            for (unsigned int i = 0; i < boundary_values.size(); ++i)
              boundary_values[i] = vector(dofs[i]);
            const auto values = interiors.recover(next++, boundary_values);
            for (unsigned int i = 0; i < values.size(); ++i)
              vector(dofs[boundary_values.size() + i]) = values[i];
          }
    }
  } // namespace

  std::vector<BodyVector>
  body_displacements(const Bodies                          &bodies,
                     const DisplacementNumbering           &numbering,
                     const AffineConstraints<double>       &constraints,
                     const std::vector<CondensedInteriors> &interiors,
                     const Vector                          &displacement)
  {
    const IndexSet &owned = displacement.locally_owned_elements();
    const MPI_Comm  comm  = bodies.front()->triangulation().get_communicator();
    Vector          all(displacement), ghosted;
    constraints.distribute(all);
    ghosted.reinit(owned, constraints.get_local_lines(), comm);
    ghosted = all;

    // filled in place: a copy would lose the ghost values
    std::vector<BodyVector> result(bodies.size());
    for (const auto &body : bodies)
      {
        BodyVector &vector = result[body->index];
        vector.reinit(body->dof_handler.locally_owned_dofs(),
                      body->relevant_dofs,
                      comm);
        for (const auto dof : body->dof_handler.locally_owned_dofs())
          vector(dof) = ghosted(numbering(body->index, dof));
        vector.update_ghost_values();
        recover_interiors(*body, interiors[body->index], vector);
        vector.update_ghost_values();
      }
    return result;
  }

  std::vector<BodyVector>
  body_displacements(const Bodies                    &bodies,
                     const DisplacementNumbering     &numbering,
                     const AffineConstraints<double> &constraints,
                     const NodalSystem               &nodal,
                     const Vector                    &displacement)
  {
    std::vector<BodyVector> result(bodies.size());
    for (const auto &body : bodies)
      result[body->index].reinit(body->dof_handler.locally_owned_dofs(),
                                 body->relevant_dofs,
                                 body->triangulation().get_communicator());
    nodal.for_each_coefficient(displacement,
                               [&](const unsigned int            body,
                                   const types::global_dof_index dof,
                                   const double                  value) {
                                 if (!result[body].in_local_range(dof))
                                   return;
                                 const auto index = numbering(body, dof);
                                 // one that hangs has both
                                 result[body](dof) =
                                   value + constraints.get_inhomogeneity(index);
                               });
    for (BodyVector &vector : result)
      vector.update_ghost_values();
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
  describe_structure(const Bodies                &bodies,
                     const DisplacementNumbering &numbering,
                     BlockSystem                 &system)
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
