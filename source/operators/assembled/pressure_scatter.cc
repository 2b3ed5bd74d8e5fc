#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <mortise/operators/assembled/pressure_scatter.h>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using Dofs = std::vector<types::global_dof_index>;

    /// @p dofs, constrained ones replaced by those that they follow from.
    Dofs
    resolved(const AffineConstraints<double> &constraints, const Dofs &dofs)
    {
      Dofs result;
      for (const auto dof : dofs)
        if (const auto *masters = constraints.get_constraint_entries(dof))
          for (const auto &entry : *masters)
            result.push_back(entry.first);
        else if (!constraints.is_constrained(dof))
          result.push_back(dof);
      std::sort(result.begin(), result.end());
      result.erase(std::unique(result.begin(), result.end()), result.end());
      return result;
    }
  } // namespace

  PressureScatter::PressureScatter(const std::vector<const Body *> &bodies,
                                   const SceneField &displacement,
                                   const SceneField &pressure,
                                   BlockSystem      &system)
    : displacement(displacement)
    , pressure(pressure)
    , system(system)
  {
    const IndexSet        &rows    = pressure.numbering.owned();
    const IndexSet        &columns = displacement.numbering.owned();
    const IndexSet        &local   = pressure.constraints.get_local_lines();
    DynamicSparsityPattern divergence(rows.size(), columns.size(), local),
      square(rows.size(), rows.size(), local);
    for (const Body *body : bodies)
      for (const auto &cell : body->dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            const Dofs all = dofs(*body, cell);
            const Dofs p   = resolved(pressure.constraints, all);
            Dofs cell_dofs =
              scene_dofs(body->index, cell, displacement.numbering);
            cell_dofs.resize(cell->get_fe().get_first_hex_index());
            const Dofs u = resolved(displacement.constraints, cell_dofs);
            for (const auto row : p)
              {
                divergence.add_entries(row, u.begin(), u.end(), true);
                square.add_entries(row, p.begin(), p.end(), true);
              }
            for (const auto dof : all)
              square.add(dof, dof);
          }
    system.divergence.reinit(
      rows, columns, divergence, system.communicator, true);
    system.compliance.reinit(rows, rows, square, system.communicator, true);
    system.pressure_norm.reinit(rows, rows, square, system.communicator, true);
  }

  std::vector<types::global_dof_index>
  PressureScatter::dofs(const Body &body, const Body::CellIterator &cell) const
  {
    return scene_dofs(body.index,
                      body.pressure->cell(cell),
                      pressure.numbering);
  }

  void
  PressureScatter::add(const PressureBlocks &blocks,
                       const Dofs           &pressures,
                       const Dofs           &displacements)
  {
    pressure.constraints.distribute_local_to_global(blocks.divergence,
                                                    pressures,
                                                    displacement.constraints,
                                                    displacements,
                                                    system.divergence);
    pressure.constraints.distribute_local_to_global(blocks.compliance,
                                                    pressures,
                                                    system.compliance);
    pressure.constraints.distribute_local_to_global(blocks.norm,
                                                    pressures,
                                                    system.pressure_norm);
  }

  void
  PressureScatter::compress()
  {
    for (SparseMatrix *matrix :
         {&system.divergence, &system.compliance, &system.pressure_norm})
      matrix->compress(VectorOperation::add);
  }
} // namespace mortise
