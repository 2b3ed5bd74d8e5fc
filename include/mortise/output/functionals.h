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

  /// int (sigma_h n) . v over @p boundary for the functions v of the cells there, forces.
  CellFunctionals
  stress_functionals(const Body                &body,
                     const BodySolution        &solution,
                     dealii::types::boundary_id boundary);

  /// int w (P n)_c over @p boundary as a functional of small changes of @p solution, w component @p c of the
  /// displacement of @p weights.
  CellFunctionals
  stress_functional(const Body                &body,
                    const BodySolution        &solution,
                    const BodySolution        &weights,
                    dealii::types::boundary_id boundary,
                    unsigned int               c);

  /// Force on a boundary, int sigma n of an exact solution. Collective.
  dealii::Tensor<1, dim>
  resultant(const Body                &body,
            const ExactSolution       &exact,
            dealii::types::boundary_id boundary);
} // namespace mortise
