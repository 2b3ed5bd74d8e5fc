// Quadrature on triangles and tetrahedra for any degree, from the rules that
// deal.II has.
#pragma once

#include <deal.II/base/quadrature.h>

#include <deal.II/fe/fe.h>

namespace mortise
{
  /// A rule with positive weights and points inside the reference triangle
  /// (dim 2) or tetrahedron (dim 3) that is exact for all polynomials of
  /// degree @p degree: the symmetric one of Witherden and Vincent (2015) where
  /// deal.II has it (up to degree 14 on triangles, 10 on tetrahedra), else
  /// Gauss points in collapsed coordinates (Duffy 1982). No point is close to a
  /// vertex: integrands may be singular there.
  template <int dim>
  dealii::Quadrature<dim>
  simplex_quadrature(unsigned int degree);

  /// For the cells (dim 3) or faces (dim 2) of @p element: the Gauss rule of @p n points per
  /// direction on hexahedra, one of the same degree 2 n - 1 on tetrahedra.
  template <int dim>
  dealii::Quadrature<dim>
  gauss_quadrature(const dealii::FiniteElement<3> &element, unsigned int n);

  /// The collapsed rule for any degree.
  template <int dim>
  dealii::Quadrature<dim>
  collapsed_quadrature(unsigned int degree);
} // namespace mortise
