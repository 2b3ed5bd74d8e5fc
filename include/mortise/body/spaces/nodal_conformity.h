// Values at Gauss-Lobatto points of hexahedra with mixed degrees and hanging
// nodes: which of a cell's nodes carry the function, and what the others follow
// with. It knows nothing of bodies.
#pragma once

#include <deal.II/lac/affine_constraints.h>

#include <mortise/body/elements/fe_legendre.h>
#include <mortise/body/spaces/entity_degrees.h>

#include <vector>

namespace mortise
{
  /// The numbering of FE_Legendre for nodes: those of two degrees on a line or
  /// face are different ones, but for the ends.
  class FE_Nodes : public FE_Legendre
  {
  public:
    using FE_Legendre::FE_Legendre;

    std::unique_ptr<dealii::FiniteElement<3>>
    clone() const override;

    std::vector<std::pair<unsigned int, unsigned int>>
    hp_line_dof_identities(
      const dealii::FiniteElement<3> &other) const override;

    std::vector<std::pair<unsigned int, unsigned int>>
    hp_quad_dof_identities(const dealii::FiniteElement<3> &other,
                           unsigned int face_no = 0) const override;
  };

  /// Indices of the nodes of @p cell of a DoFHandler of FE_Nodes, in the order of deal.II's
  /// FE_Q.
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

  /// What the values at nodes that do not carry the function of the
  /// hierarchical space of the same degrees follow from, for the nodes of owned
  /// cells at
  /// least. @p constraints is initialised here and left open. Collective.
  void
  make_nodal_constraints(const dealii::DoFHandler<3>       &dof_handler,
                         const EntityDegrees               &degrees,
                         dealii::AffineConstraints<double> &constraints);
} // namespace mortise
