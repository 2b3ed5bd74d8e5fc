// Constraints that make hp spaces of FE_Legendre (hexahedra, with hanging
// nodes) and FE_SimplexLegendre (tetrahedra) conforming where degrees are
// mixed, by the minimum rule, on any number of ranks. It never applies boundary
// conditions and never changes a mesh.
#pragma once

#include <deal.II/grid/tria.h>

#include <deal.II/lac/affine_constraints.h>

#include <mortise/body/spaces/entity_degrees.h>


namespace mortise
{
  /// Conforming hp and hanging-node constraints of @p dof_handler, whose elements are as for
  /// EntityDegrees: hexahedra that are consistently ordered, on serial or
  /// parallel::distributed triangulations; tetrahedra on serial or distributed
  /// ones with a layer of ghost cells. Collective.
  ///
  /// Most of the equalities between modes of tetrahedra deal.II makes itself
  /// by giving equal modes one index (all of them where the cells have one
  /// degree and two orders of vertices); where more than two elements meet,
  /// some remain to be made here.
  ///
  /// @p constraints is initialised here, so this comes first; its set of lines holds the locally
  /// relevant degrees of freedom and every one that the constraints of this
  /// rank refer to. It is left open: add boundary conditions, then call
  /// complete_constraints() and close(). Lines are made for all degrees of
  /// freedom of locally owned and ghost cells.
  void
  make_conformity_constraints(const dealii::DoFHandler<3>       &dof_handler,
                              dealii::AffineConstraints<double> &constraints);

  /// The same with degrees that are at hand.
  void
  make_conformity_constraints(const dealii::DoFHandler<3>       &dof_handler,
                              const EntityDegrees               &degrees,
                              dealii::AffineConstraints<double> &constraints);

  /// After boundary conditions were added to @p constraints (by each rank for the degrees of
  /// freedom of its owned and ghost cells) and before close(): every rank
  /// learns the lines of all degrees of freedom in its set from their owners.
  /// Collective; nothing to do on one rank.
  void
  complete_constraints(const dealii::DoFHandler<3>       &dof_handler,
                       dealii::AffineConstraints<double> &constraints);

  /// Whether every face of every cell is standard or transposed and every line
  /// standard, which hierarchical functions need:
  /// GridTools::consistently_order_cells() on the coarse cells gives it where
  /// it can be had (not on a Moebius strip, for example; there one uniform
  /// refinement, made into a coarse mesh of its own, can be ordered). Looks at
  /// the coarse cells only.
  bool
  is_consistently_ordered(const dealii::Triangulation<3> &triangulation);
} // namespace mortise
