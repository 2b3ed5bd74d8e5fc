// Cells of any shape cut into tetrahedra that have no new vertices. Knows no
// triangulation.
#pragma once

#include <mortise/body/mesh/gmsh_model.h>

#include <array>
#include <vector>

namespace mortise
{
  /// Local vertices of the tetrahedra (of positive volume) into which a cell is
  /// cut, whose @p vertices have these numbers in gmsh's order: 4 of a
  /// tetrahedron, 5 of a pyramid, 6 of a wedge or 8 of a hexahedron. All
  /// tetrahedra share the vertex of lowest number, and each quadrilateral is
  /// cut by the diagonal through its own lowest vertex, so that neighbours fit
  /// whatever their shapes. Source: Dompierre, Labbe, Vallet, Camarero, How to
  /// subdivide pyramids, prisms and hexahedra into tetrahedra (1999).
  std::vector<std::array<unsigned int, 4>>
  cut_cell(const std::vector<unsigned int> &vertices);

  /// The @p vertices of a triangle, quadrilateral or hexahedron of deal.II in
  /// gmsh's order, which goes around faces.
  std::vector<unsigned int>
  around(std::vector<unsigned int> vertices);

  /// Local vertices of the triangles of a quadrilateral whose vertices @p around
  /// it have these numbers, by the same rule.
  std::array<std::array<unsigned int, 3>, 2>
  cut_quadrilateral(const std::array<unsigned int, 4> &around);

  /// @p model with tetrahedra in place of all cells and triangles in place of
  /// all quadrilaterals, which become of first order since they only give
  /// names. Cells of second order keep their curved sides: the middle of a
  /// diagonal is the middle of its face or cell. Blocks of higher order are
  /// left as they are.
  GmshModel
  cut_into_tetrahedra(const GmshModel &model);
} // namespace mortise
