// The Lagrange cells of VTK: which nodes they have, in which order. It knows no
// fields.
#pragma once

#include <array>
#include <vector>

namespace mortise
{
  /// Reference shapes: the corners of the triangle and of the tetrahedron are
  /// the origin and the ends of the axes, those of the others are in [0,1]^d.
  enum class LagrangeShape : unsigned char
  {
    triangle,
    quadrilateral,
    tetrahedron,
    hexahedron
  };

  /// Nodes at even distances, by number in VTK: coordinates times @p degree (>= 1), the third is
  /// zero on faces. Hexahedra are those of VTU files of version 1.0, which all
  /// readers take; from version 2.2 on the last two edges are exchanged. Made
  /// once.
  const std::vector<std::array<unsigned int, 3>> &
  lagrange_nodes(LagrangeShape shape, unsigned int degree);

  /// The number of VTK for the type of a cell: linear ones have their own.
  unsigned int
  vtk_type(LagrangeShape shape, unsigned int degree);
} // namespace mortise
