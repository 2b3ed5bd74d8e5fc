#include <mortise/operators/scene_field.h>

namespace mortise
{
  using namespace dealii;

  std::vector<types::global_dof_index>
  scene_dofs(const unsigned int                           body,
             const DoFHandler<dim>::active_cell_iterator &cell,
             const FieldNumbering                        &numbering)
  {
    std::vector<types::global_dof_index> dofs(cell->get_fe().n_dofs_per_cell());
    cell->get_dof_indices(dofs);
    for (auto &dof : dofs)
      dof = numbering(body, dof);
    return dofs;
  }
} // namespace mortise
