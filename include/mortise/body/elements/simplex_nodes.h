// Values at nodes as a basis of the polynomials of a tetrahedron and of its
// faces: the nodes, and the way from and to hierarchical modes.
#pragma once

#include <deal.II/base/point.h>

#include <deal.II/lac/full_matrix.h>

#include <mortise/body/mesh/vertex_order.h>

#include <vector>

namespace mortise
{
  /// Vertices of a line, a face or the whole cell, as bits.
  using VertexSet = unsigned int;

  /// By function of FE_SimplexLegendre(degree): what it belongs to, in local
  /// vertices.
  std::vector<VertexSet>
  sets_of_functions(unsigned int degree);

  /// The points of simplex_interpolation_points() in the order of the functions
  /// of FE_SimplexLegendre(degree) with ascending vertices: as many on each
  /// line, on each face and inside as it has modes there. What is on a line or
  /// face depends on that and its ascending vertices only. Tables are made
  /// once. @p degree: 1..8.
  const std::vector<dealii::Point<3>> &
  simplex_nodes(unsigned int degree);

  /// Values at these nodes of the functions of the element: entry (node, mode).
  const dealii::FullMatrix<double> &
  simplex_modes_to_nodes(unsigned int degree);

  /// The inverse.
  const dealii::FullMatrix<double> &
  simplex_nodes_to_modes(unsigned int degree);

  /// The inverse on a face, both in the order of TraceBasis: entry (mode,
  /// node).
  const dealii::FullMatrix<double> &
  triangle_nodes_to_modes(unsigned int degree);

  /// For each function of FE_SimplexLegendre(degree) the one of the same line,
  /// face, .. (by ascending vertices) of FE_SimplexLegendre(degree, order).
  std::vector<unsigned int>
  ascending_dof_indices(unsigned int degree, const VertexOrder &order);

  /// Values at @p points (by ascending vertices) of the polynomials that are
  /// one at one node and zero at the others: entry (point, node).
  dealii::FullMatrix<double>
  simplex_nodal_values(unsigned int                         degree,
                       const std::vector<dealii::Point<3>> &points);

  /// Their derivatives along the axes of the reference tetrahedron: entry (d
  /// points.size() + point, node) along axis d.
  dealii::FullMatrix<double>
  simplex_nodal_gradients(unsigned int                         degree,
                          const std::vector<dealii::Point<3>> &points);
} // namespace mortise
