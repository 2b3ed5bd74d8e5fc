// The reference shapes of faces.
#pragma once

namespace mortise
{
  /// The value is the number of vertices. The reference triangle has the
  /// vertices (0,0), (1,0), (0,1); the reference quadrilateral is the unit
  /// square with the vertices (0,0), (1,0), (0,1), (1,1).
  enum class FaceShape : unsigned char
  {
    triangle      = 3,
    quadrilateral = 4
  };

  constexpr unsigned int
  n_vertices(const FaceShape shape)
  {
    return static_cast<unsigned int>(shape);
  }
} // namespace mortise
