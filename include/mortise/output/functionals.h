// Numbers that are asked of a solution, and the linear functionals that they
// are.
#pragma once

#include <mortise/base/types.h>
#include <mortise/material/exact_solution.h>
#include <mortise/operators/cell_functional.h>
#include <mortise/operators/scene_solution.h>

#include <optional>

namespace mortise
{
  /// Is @p point in @p body, to rounding? Collective.
  bool
  contains(const Body &body, const dealii::Point<dim> &point);

  /// Displacement at a point of a body; absent if the point lies outside
  /// (farther than rounding). Collective.
  std::optional<dealii::Tensor<1, dim>>
  point_value(const Body               &body,
              const BodyVector         &displacement,
              const dealii::Point<dim> &point);

  /// Component @p c of point_value(), on one cell of one rank; nothing on any if the point
  /// lies outside. Collective.
  CellFunctionals
  point_functional(const Body               &body,
                   const dealii::Point<dim> &point,
                   unsigned int              c);

  /// Force on a boundary, int sigma_h n. Collective.
  dealii::Tensor<1, dim>
  resultant(const Body                &body,
            const BodySolution        &solution,
            dealii::types::boundary_id boundary);

  /// That of an exact solution, by the same rule. Collective.
  dealii::Tensor<1, dim>
  resultant(const Body                &body,
            const ExactSolution       &exact,
            dealii::types::boundary_id boundary);

  /// Component @p c of resultant().
  CellFunctionals
  resultant_functional(const Body                &body,
                       dealii::types::boundary_id boundary,
                       unsigned int               c);
} // namespace mortise
