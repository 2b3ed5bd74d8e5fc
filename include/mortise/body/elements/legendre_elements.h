// The hierarchical elements of a space and which of them each cell takes, for
// both shapes of cells.
#pragma once

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/grid/reference_cell.h>

#include <deal.II/hp/fe_collection.h>

#include <functional>
#include <set>
#include <vector>

namespace mortise
{
  /// Systems of @p n_components FE_Legendre or FE_SimplexLegendre (the element
  /// itself for one component), or NodesOf these where @p nodal, rising
  /// @p degrees, in @p fe, and the dofs of @p dof_handler, whose owned cells have
  /// the degree @p degree_of. Collective.
  void
  distribute_legendre_dofs(
    const std::set<unsigned int>                            &degrees,
    const std::function<unsigned int(
      const dealii::DoFHandler<3>::active_cell_iterator &)> &degree_of,
    unsigned int                                             n_components,
    dealii::hp::FECollection<3>                             &fe,
    dealii::DoFHandler<3>                                   &dof_handler,
    bool                                                     nodal = false);

  /// Where the modes of the scalar element of degree @p lower stand among those of degree @p higher, on a
  /// hexahedron, or a tetrahedron of one order of vertices: the former are
  /// modes of the latter.
  std::vector<unsigned int>
  nested_modes(const dealii::ReferenceCell &cell,
               unsigned int                 lower,
               unsigned int                 higher);
} // namespace mortise
