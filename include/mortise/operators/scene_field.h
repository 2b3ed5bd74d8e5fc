// One field of all bodies in the numbering of the scene.
#pragma once

#include <deal.II/lac/affine_constraints.h>

#include <mortise/base/types.h>
#include <mortise/body/spaces/numbering.h>

#include <vector>

namespace mortise
{
  struct SceneField
  {
    FieldNumbering                    numbering;
    dealii::AffineConstraints<double> constraints; ///< closed, homogeneous
  };

  /// The indices in the scene of the dofs of @p cell, which body @p body owns.
  std::vector<dealii::types::global_dof_index>
  scene_dofs(unsigned int                                         body,
             const dealii::DoFHandler<dim>::active_cell_iterator &cell,
             const FieldNumbering                                &numbering);
} // namespace mortise
