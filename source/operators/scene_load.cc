#include <mortise/operators/cells/load_kernel.h>
#include <mortise/operators/scene_load.h>

#include <map>
#include <memory>

namespace mortise
{
  using namespace dealii;

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
      if (cell->is_locally_owned() &&
          (loads.body_force ||
           (!loads.tractions.empty() && cell->at_boundary())))
        {
          auto &kernel = kernels[cell->active_fe_index()];
          if (!kernel)
            kernel = std::make_unique<LoadKernel>(body, cell->get_fe());
          visit(cell, kernel->compute(cell, loads));
        }
  }
} // namespace mortise
