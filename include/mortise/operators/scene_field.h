// One field of all bodies in the numbering of the scene.
#pragma once

#include <deal.II/lac/affine_constraints.h>

#include <mortise/base/types.h>
#include <mortise/body/spaces/numbering.h>

namespace mortise
{
  struct SceneField
  {
    FieldNumbering                    numbering;
    dealii::AffineConstraints<double> constraints; ///< closed, homogeneous
  };
} // namespace mortise
