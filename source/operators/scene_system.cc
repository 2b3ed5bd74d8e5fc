#include <mortise/operators/scene_system.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  AffineConstraints<double>
  scene_constraints(const Bodies                                 &bodies,
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

  void
  assemble_bodies(const Bodies                    &bodies,
                  const std::vector<Loads>        &loads,
                  const DisplacementNumbering     &numbering,
                  const AffineConstraints<double> &constraints,
                  BlockSystem                     &system)
  {
    const IndexSet        &owned = numbering.owned();
    {
      // rows of all dofs that the cells of this rank touch
      DynamicSparsityPattern sparsity(owned.size(), owned.size(), constraints.get_local_lines());
      for (const auto &body : bodies)
        add_cell_couplings(*body, numbering, constraints, sparsity);
      system.stiffness.reinit(owned, owned, sparsity, system.communicator, true);
    }
    system.load.reinit(owned, system.communicator);
    for (const auto &body : bodies)
      assemble_elasticity(
        *body, loads[body->index], numbering, constraints, system.stiffness, system.load);
    system.stiffness.compress(VectorOperation::add);
    system.load.compress(VectorOperation::add);
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
          if (owned.is_element(dofs[i]) && !seen[owned.index_within_set(dofs[i])])
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
            const auto take   = [&](const unsigned int begin, const unsigned int n) {
              auto block = collector.take(dofs, begin, begin + n);
              if (!block.empty())
                system.entity_blocks.push_back(block);
              return block;
            };
            for (const unsigned int v : cell->vertex_indices())
              {
                const auto block = take(dim * v, dim);
                Assert(block.empty() || block.size() == dim, ExcInternalError());
                if (block.empty())
                  continue;
                system.vertex_dofs.insert(system.vertex_dofs.end(), block.begin(), block.end());
                system.vertex_points.push_back(cell->vertex(v));
                system.vertex_body.push_back(body->index);
              }
            for (const unsigned int l : cell->line_indices())
              take(fe.get_first_line_index() + l * fe.n_dofs_per_line(), fe.n_dofs_per_line());
            for (const unsigned int f : cell->face_indices())
              take(fe.get_first_quad_index(f), fe.n_dofs_per_quad(f));
            take(fe.get_first_hex_index(), fe.n_dofs_per_hex());
          }
    system.max_degree = Utilities::MPI::max(system.max_degree, system.communicator);
  }
} // namespace mortise
