// Where the faces of the unit hexahedron are: face coordinates, edges and
// vertices of a face in the coordinates of its own cell. Face f has the normal
// direction d = f / 2 and the face coordinates (xi, eta) along the cell
// directions (d + 1) % 3 and (d + 2) % 3, as in deal.II's faces in standard
// orientation.
#pragma once

#include <deal.II/base/point.h>

namespace mortise::face_topology
{
  /// Cell direction (0..2) of face coordinate @p a (0: xi, 1: eta) of face @p f.
  inline unsigned int
  direction(const unsigned int f, const unsigned int a)
  {
    return (f / 2 + 1 + a) % 3;
  }

  /// Point of the unit cell at face coordinates (xi, eta) of face @p f.
  inline dealii::Point<3>
  unit_point(const unsigned int f, const double xi, const double eta)
  {
    dealii::Point<3> p;
    p[f / 2]           = f % 2;
    p[direction(f, 0)] = xi;
    p[direction(f, 1)] = eta;
    return p;
  }

  /// Vertex number of the cell at corner (i, j), i, j in {0, 1}, of face @p f.
  inline unsigned int
  vertex(const unsigned int f, const unsigned int i, const unsigned int j)
  {
    return ((f % 2) << (f / 2)) + (i << direction(f, 0)) +
           (j << direction(f, 1));
  }

  /// Line number of the cell for the edge of face @p f that runs along face coordinate @p a at @p side
  /// (0 or 1) of the other face coordinate.
  inline unsigned int
  line(const unsigned int f, const unsigned int a, const unsigned int side)
  {
    unsigned int x[3];
    x[f / 2]               = f % 2;
    x[direction(f, 1 - a)] = side;
    switch (direction(f, a))
      {
        case 0:
          return 2 + x[1] + 4 * x[2];
        case 1:
          return x[0] + 4 * x[2];
        default:
          return 8 + x[0] + 2 * x[1];
      }
  }

  /// +1 if (dx/dxi) x (dx/deta) points out of the cell at face @p f, else -1 (right-handed cells).
  inline double
  outward_sign(const unsigned int f)
  {
    return f % 2 == 1 ? 1. : -1.;
  }
} // namespace mortise::face_topology
