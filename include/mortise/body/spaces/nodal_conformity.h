// Values at nodes of cells with mixed degrees and hanging nodes: which of a
// cell's nodes carry the function, and what the others follow with. It knows
// nothing of bodies.
#pragma once

#include <deal.II/lac/affine_constraints.h>

#include <mortise/body/spaces/entity_degrees.h>

#include <vector>

namespace mortise
{
  /// Indices of the nodes of the hexahedron @p cell, Gauss-Lobatto points, of a
  /// DoFHandler of NodesOf<FE_Legendre>, in the order of deal.II's FE_Q.
  ///
  /// A line or face of degree p (see EntityDegrees) belongs to the cells of
  /// the least degree s >= p around it. Where s > p (a coarse cell beside fine
  /// ones of lower degree) p - 1 of the s - 1 nodes along each direction carry
  /// the polynomials, those with the least Lebesgue constant.
  /// @p nodes is resized.
  void
  get_nodes(const EntityDegrees::CellIterator            &cell,
            const EntityDegrees                          &degrees,
            std::vector<dealii::types::global_dof_index> &nodes);

  /// Constraints of the nodes (at least those of owned cells) that do not carry
  /// a function of the hierarchical space of the same degrees. @p constraints
  /// is initialised here and left open. Collective.
  void
  make_nodal_constraints(const dealii::DoFHandler<3>       &dof_handler,
                         const EntityDegrees               &degrees,
                         dealii::AffineConstraints<double> &constraints);

  /// The same for tetrahedra: lines and faces belong to the cells of the least
  /// degree around them.
  void
  make_simplex_nodal_constraints(
    const dealii::DoFHandler<3>       &dof_handler,
    const EntityDegrees               &degrees,
    dealii::AffineConstraints<double> &constraints);
} // namespace mortise
