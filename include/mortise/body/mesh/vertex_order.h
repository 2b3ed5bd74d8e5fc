// Order of the vertices of a tetrahedron by their places in space, on which the
// hierarchical functions of tetrahedra depend, and cells whose vertices are
// numbered in it. Independent of deal.II's orientation flags.
#pragma once

#include <deal.II/base/point.h>

#include <deal.II/grid/tria.h>

#include <array>
#include <vector>

namespace mortise
{
  /// Local vertices of a tetrahedron, the lowest first. A point is lower than
  /// another if its x is less, or its y where x is equal, or else its z. This
  /// is the same seen from all cells and ranks that share an edge or a face,
  /// however they number its vertices, so functions that depend on a cell
  /// only through it fit together: source: Ainsworth and Coyle, Hierarchic
  /// finite element bases on unstructured tetrahedral meshes (2003), where
  /// global numbers take the place of coordinates.
  using VertexOrder = std::array<unsigned int, 4>;

  /// Local vertices of the lines and faces of deal.II's tetrahedron.
  constexpr unsigned int tetrahedron_lines[6][2] =
    {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  constexpr unsigned int tetrahedron_faces[4][3] = {{0, 1, 2},
                                                    {1, 0, 3},
                                                    {0, 2, 3},
                                                    {2, 1, 3}};

  /// Of a point of the reference tetrahedron.
  inline std::array<double, 4>
  barycentric_coordinates(const dealii::Point<3> &x)
  {
    return {{1. - x[0] - x[1] - x[2], x[0], x[1], x[2]}};
  }

  /// Order of four different points.
  VertexOrder
  vertex_order(const std::array<dealii::Point<3>, 4> &points);

  /// Order of the vertices of a tetrahedron, as the triangulation has them
  /// (a mapping plays no role).
  VertexOrder
  vertex_order(const dealii::Triangulation<3>::cell_iterator &cell);

  /// Place of the local vertices in @p order: the inverse permutation.
  VertexOrder
  vertex_ranks(const VertexOrder &order);

  /// The two orders that positive cells have after order_vertices().
  const std::vector<VertexOrder> &
  standard_vertex_orders();

  /// Renumber the vertices of each of @p cells (tetrahedra of @p vertices) in
  /// ascending order, with the last two swapped where the volume would be
  /// negative: then two of the 24 orders are left, whatever the mesh.
  void
  order_vertices(const std::vector<dealii::Point<3>> &vertices,
                 std::vector<dealii::CellData<3>>    &cells);
} // namespace mortise
