// The elements of a space on tetrahedra: one for each degree and each order of
// vertices, and the one that a cell takes.
#pragma once

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/hp/fe_collection.h>

#include <mortise/body/elements/fe_simplex_legendre.h>

#include <vector>

namespace mortise
{
  class SimplexElements
  {
  public:
    /// FESystem(FE_SimplexLegendre(p, order), n_components), or the scalar
    /// element itself for one component, for all of @p degrees (ascending) and
    /// @p orders: two orders are enough for meshes of order_vertices().
    SimplexElements(
      const std::vector<unsigned int> &degrees,
      unsigned int                     n_components = 1,
      const std::vector<VertexOrder>  &orders       = standard_vertex_orders());

    /// Place in collection of the element of degree @p degree for @p cell.
    /// An exception if the cell has another order or the degree is missing.
    unsigned int
    index(const dealii::Triangulation<3>::cell_iterator &cell,
          unsigned int                                   degree) const;

    /// FE_SimplexLegendre behind an element of the collection.
    static const FE_SimplexLegendre &
    base(const dealii::FiniteElement<3> &element);

    dealii::hp::FECollection<3> collection;

  private:
    const std::vector<unsigned int> degrees;
    const std::vector<VertexOrder>  orders;
  };
} // namespace mortise
