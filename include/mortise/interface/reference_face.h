// The reference domains of faces, see face_shape.h: centre, area, sides, edges
// and tests of points.
#pragma once

#include <mortise/body/elements/face_shape.h>
#include <mortise/interface/lanes.h>

#include <array>
#include <cmath>

namespace mortise
{
  /// Both coordinates of the point at which a FaceFrame has its tangents.
  constexpr double
  center_coordinate(const FaceShape shape)
  {
    return shape == FaceShape::triangle ? 1. / 3. : 0.5;
  }

  constexpr double
  reference_area(const FaceShape shape)
  {
    return shape == FaceShape::triangle ? 0.5 : 1.;
  }

  /// Reference coordinates this close to a side are on it.
  constexpr double on_side = 1e-13;

  /// The sides of one shape. 0: xi_1 >= 0, 1: xi_1 <= 1, 2: xi_2 >= 0, 3: xi_2
  /// <= 1, 4: xi_1 + xi_2 <= 1.
  struct Sides
  {
    unsigned int n;
    unsigned int number[4];

    const unsigned int *
    begin() const
    {
      return number;
    }
    const unsigned int *
    end() const
    {
      return number + n;
    }
  };

  constexpr unsigned int hypotenuse = 4;

  inline const Sides &
  sides_of(const FaceShape shape)
  {
    static constexpr Sides triangle{3, {0, 2, hypotenuse, 0}},
      square{4, {0, 1, 2, 3}};
    return shape == FaceShape::triangle ? triangle : square;
  }

  /// Distance of xi from a side along a coordinate, positive inside.
  inline double
  inside_by(const double (&xi)[2], const unsigned int side)
  {
    return side == hypotenuse ? 1. - xi[0] - xi[1] :
           side % 2 == 0      ? xi[side / 2] :
                                1. - xi[side / 2];
  }

  /// d/dt inside_by(xi, side) for dxi = d/dt xi.
  inline double
  inside_rate(const double (&dxi)[2], const unsigned int side)
  {
    return side == hypotenuse ? -dxi[0] - dxi[1] :
           side % 2 == 0      ? dxi[side / 2] :
                                -dxi[side / 2];
  }

  /// The direction of a side, coordinate @p i.
  inline double
  side_direction(const unsigned int side, const unsigned int i)
  {
    return side == hypotenuse ? (i == 0 ? -1. : 1.) : side / 2 == i ? 0. : 1.;
  }

  /// Put xi on a side, so that inside_by() is exactly zero.
  inline void
  put_on_side(double (&xi)[2], const unsigned int side)
  {
    if (side == hypotenuse)
      xi[1] = 1. - xi[0];
    else
      xi[side / 2] = side % 2;
  }

  /// Put coordinates that are on a side exactly there, and at a vertex exactly
  /// there.
  inline void
  snap_to_sides(const FaceShape shape, double (&xi)[2])
  {
    for (auto &x : xi)
      x = std::abs(x) <= on_side ? 0. : std::abs(1. - x) <= on_side ? 1. : x;
    if (shape == FaceShape::triangle &&
        std::abs(inside_by(xi, hypotenuse)) <= on_side)
      put_on_side(xi, hypotenuse);
  }

  /// Both points are outside on one of the other sides: a crossing of @p side
  /// between them is of no interest.
  inline bool
  both_beside(const FaceShape shape,
              const double (&a)[2],
              const double (&b)[2],
              const unsigned int side)
  {
    for (const unsigned int other : sides_of(shape))
      if (other != side && inside_by(a, other) < -on_side &&
          inside_by(b, other) < -on_side)
        return true;
    return false;
  }

  /// xi is inside by more than rounding.
  inline bool
  lies_inside(const FaceShape shape, const double xi_1, const double xi_2)
  {
    return xi_1 > 0 && xi_2 > 0 &&
           (shape == FaceShape::triangle ? xi_1 + xi_2 < 1 :
                                           xi_1 < 1 && xi_2 < 1);
  }

  /// The nearest point, side by side, in the shape enlarged by @p margin;
  /// beyond the hypotenuse along the ray to the opposite vertex of the enlarged
  /// triangle. Continuous in xi, which stays as it is inside.
  inline void
  clamp_into(const FaceShape shape, const double margin, Lanes (&xi)[2])
  {
    if (shape == FaceShape::quadrilateral)
      for (auto &x : xi)
        x = minimum(maximum(x, broadcast(-margin)), broadcast(1. + margin));
    else
      {
        for (auto &x : xi)
          x = maximum(x, broadcast(-margin));
        const double most  = 1. + 3. * margin;
        const Lanes  reach = xi[0] + xi[1] + 2. * margin;
        for (auto &x : xi)
          x = reach > most ? (x + margin) * (most / reach) - margin : x;
      }
  }

  /// Coordinates that bound a face: xi_1, xi_2 and, for a triangle, their sum.
  constexpr unsigned int
  n_chart_axes(const FaceShape shape)
  {
    return shape == FaceShape::triangle ? 3 : 2;
  }

  /// A box of reference coordinates with, for a triangle, a bound of xi_1 +
  /// xi_2 that cuts its corner off; for a square that bound is infinite.
  struct ReferenceBox
  {
    std::array<double, 2> lower;
    std::array<double, 3> upper;

    /// Distance from the box along a coordinate, negative inside.
    Lanes
    outside_by(const Lanes (&xi)[2]) const
    {
      return maximum(xi[0] + xi[1] - upper[2],
                     maximum(maximum(lower[0] - xi[0], xi[0] - upper[0]),
                             maximum(lower[1] - xi[1], xi[1] - upper[1])));
    }
  };

  /// Reference coordinates of the point tau of edge @p edge, counter-clockwise
  /// as tau goes from 0 to 1. Square: 0: xi_2 = 0, 1: xi_1 = 1, 2: xi_2 = 1, 3:
  /// xi_1 = 0. Triangle: 0: xi_2 = 0, 1: the hypotenuse, 2: xi_1 = 0.
  inline std::array<double, 2>
  edge_coordinates(const FaceShape    shape,
                   const unsigned int edge,
                   const double       tau)
  {
    const bool triangle = shape == FaceShape::triangle;
    switch (edge)
      {
        case 0:
          return {{tau, 0.}};
        case 1:
          return {{triangle ? 1. - tau : 1., tau}};
        case 2:
          return {{triangle ? 0. : 1. - tau, triangle ? 1. - tau : 1.}};
        default:
          return {{0., 1. - tau}};
      }
  }
} // namespace mortise
