// Values at nodes of tetrahedra with mixed degrees: the elements that number
// them, and what nodes follow with on lines and faces of lower degree. It knows
// nothing of bodies.
#pragma once

#include <deal.II/lac/affine_constraints.h>

#include <mortise/body/elements/fe_simplex_legendre.h>
#include <mortise/body/spaces/entity_degrees.h>

#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace mortise
{
  /// The numbering of FE_SimplexLegendre for nodes: those of two degrees on a
  /// line or face are different ones.
  class FE_SimplexNodes : public FE_SimplexLegendre
  {
  public:
    using FE_SimplexLegendre::FE_SimplexLegendre;

    std::unique_ptr<dealii::FiniteElement<3>>
    clone() const override;

    std::vector<std::pair<unsigned int, unsigned int>>
    hp_line_dof_identities(
      const dealii::FiniteElement<3> &other) const override;

    std::vector<std::pair<unsigned int, unsigned int>>
    hp_quad_dof_identities(const dealii::FiniteElement<3> &other,
                           unsigned int face_no = 0) const override;
  };

  /// Elements of @p degrees, rising, and the dofs of @p dof_handler, whose owned
  /// cells have the degree @p degree_of. Collective.
  void
  distribute_simplex_nodes(
    const std::vector<unsigned int>                         &degrees,
    const std::function<unsigned int(
      const dealii::DoFHandler<3>::active_cell_iterator &)> &degree_of,
    dealii::DoFHandler<3>                                   &dof_handler);

  /// What the values at the nodes of owned cells follow from that do not carry
  /// the function of the hierarchical space of the same degrees: those of a
  /// line or face belong to the cells of the least degree around it.
  /// @p constraints is initialised here and left open. Collective.
  void
  make_simplex_nodal_constraints(
    const dealii::DoFHandler<3>       &dof_handler,
    const EntityDegrees               &degrees,
    dealii::AffineConstraints<double> &constraints);
} // namespace mortise
