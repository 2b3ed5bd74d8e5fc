// Constraints that make hp spaces of FE_SimplexLegendre conforming where
// degrees differ, by the minimum rule, on any number of ranks. Tetrahedra have
// no hanging nodes here. It never applies boundary conditions.
#pragma once

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/lac/affine_constraints.h>

namespace mortise
{
  /// The degree of a line or face is the least of all cells around it; modes
  /// above it are zero, modes up to it are one, whichever element they belong
  /// to. Most of these equalities deal.II makes itself by giving equal modes
  /// one index (all of them where the cells have one degree and two orders of
  /// vertices); where more than two elements meet, some remain to be made.
  ///
  /// @p dof_handler: its elements are those of SimplexElements, its cells one
  /// level of tetrahedra, serial or distributed with a layer of ghost cells.
  /// Collective. @p constraints is initialised here and left open: add
  /// boundary conditions, then call complete_constraints() and close().
  void
  make_simplex_constraints(const dealii::DoFHandler<3>       &dof_handler,
                           dealii::AffineConstraints<double> &constraints);
} // namespace mortise
