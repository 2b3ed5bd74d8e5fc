#include <mortise/operators/assembled/load_kernel.h>
#include <mortise/operators/scene_load.h>

#include <memory>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using Dofs = std::vector<types::global_dof_index>;

    bool
    is_loaded(const Body::CellIterator &cell, const Loads &loads)
    {
      return loads.body_force ||
             (!loads.tractions.empty() && cell->at_boundary());
    }

    /// load -= K_c g with the columns of a cell.
    void
    subtract(const PrescribedColumns::Cell &cell,
             const PrescribedValues        &prescribed,
             const Dofs                    &dofs,
             dealii::Vector<double>        &load)
    {
      for (unsigned int j = 0; j < cell.columns.size(); ++j)
        if (const double value =
              prescribed_value(prescribed, dofs[cell.columns[j]]);
            value != 0.)
          for (unsigned int i = 0; i < cell.block.m(); ++i)
            load(i) -= cell.block(i, j) * value;
    }
  } // namespace

  PrescribedValues
  prescribed_values(const AffineConstraints<double> &constraints)
  {
    PrescribedValues values;
    for (const auto &line : constraints.get_lines())
      if (line.inhomogeneity != 0.)
        values.emplace(line.index, line.inhomogeneity);
    return values;
  }

  void
  for_each_loaded_cell(
    const Body                                                &body,
    const Loads                                               &loads,
    const std::function<void(const Body::CellIterator &,
                             const dealii::Vector<double> &)> &visit)
  {
    std::map<unsigned int, std::unique_ptr<LoadKernel>> kernels;
    for (const auto &cell : body.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned() && is_loaded(cell, loads))
        {
          auto &kernel = kernels[cell->active_fe_index()];
          if (!kernel)
            kernel = std::make_unique<LoadKernel>(body, cell->get_fe());
          visit(cell, kernel->compute(cell, loads));
        }
  }

  namespace
  {
    /// The load of a cell with its pressures behind the displacements of its
    /// boundary, where the cell has any.
    dealii::Vector<double>
    with_pressures(const dealii::Vector<double> &displacements,
                   const unsigned int            n_b,
                   const unsigned int            n_p)
    {
      dealii::Vector<double> all(displacements.size() + n_p);
      for (unsigned int i = 0; i < displacements.size(); ++i)
        all(i < n_b ? i : i + n_p) = displacements(i);
      return all;
    }

    /// The leading part of @p load into the right hand side.
    void
    distribute(const dealii::Vector<double>    &load,
               const unsigned int               begin,
               const Dofs                      &dofs,
               const AffineConstraints<double> &constraints,
               Vector                          &rhs)
    {
      dealii::Vector<double> part(dofs.size());
      for (unsigned int i = 0; i < dofs.size(); ++i)
        part(i) = load(begin + i);
      constraints.distribute_local_to_global(part, dofs, rhs);
    }
  } // namespace

  void
  add_assembled_load(const Body          &body,
                     const Loads         &loads,
                     const AssembledBody &assembled,
                     const SceneField    &displacement,
                     const SceneField    *pressure,
                     SceneLoad           &load)
  {
    auto &interiors = load.interiors[body.index];
    interiors.assign(assembled.interiors.n_cells(), {});
    std::map<unsigned int, std::unique_ptr<LoadKernel>> kernels;
    unsigned int                                        next = 0;
    for (const auto &cell : body.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const unsigned int n_u = cell->get_fe().n_dofs_per_cell(),
                             n_b = cell->get_fe().get_first_hex_index();
          const unsigned int interior = next;
          next += n_b < n_u ? 1 : 0;
          const auto columns =
            assembled.prescribed.cells.find(cell->active_cell_index());
          const bool constrained = columns != assembled.prescribed.cells.end() &&
                            !load.prescribed.empty();
          if (!is_loaded(cell, loads) && !constrained)
            continue;

          auto &kernel = kernels[cell->active_fe_index()];
          if (!kernel)
            kernel = std::make_unique<LoadKernel>(body, cell->get_fe());
          Dofs dofs = scene_dofs(body.index, cell, displacement.numbering);
          Dofs pressures;
          if (body.pressure)
            pressures = scene_dofs(body.index,
                                   body.pressure->cell(cell),
                                   pressure->numbering);
          auto of_cell = with_pressures(kernel->compute(cell, loads),
                                        n_b,
                                        pressures.size());
          if (loads.body_force && n_b < n_u)
            interiors[interior] =
              assembled.interiors.condense(interior, of_cell);
          if (constrained)
            subtract(columns->second, load.prescribed, dofs, of_cell);
          dofs.resize(n_b);
          distribute(of_cell,
                     0,
                     dofs,
                     displacement.constraints,
                     load.rhs.displacement);
          if (body.pressure)
            distribute(of_cell,
                       n_b,
                       pressures,
                       pressure->constraints,
                       load.rhs.pressure);
        }
  }
} // namespace mortise
