// A cube, a wedge and a tetrahedron that share faces, straight and bent, in the
// order of nodes that Abaqus and VTK have.
#pragma once

#include <deal.II/base/quadrature_lib.h>

#include <mortise/body/elements/simplex_quadrature.h>
#include <mortise/body/mesh/mesh_measures.h>

#include <array>
#include <numeric>
#include <vector>

namespace three_shapes
{
  using namespace dealii;

  /// x + bend(x), of degree 2 in all.
  inline Point<3>
  bent(const Point<3> &x)
  {
    return {x[0] + 0.2 * x[1] * x[2],
            x[1] + 0.3 * x[2] * x[2],
            x[2] + 0.2 * x[0] * x[0] - 0.1 * x[0] * x[1]};
  }

  inline double
  bent_determinant(const Point<3> &x)
  {
    Tensor<2, 3> J;
    J[0] = Point<3>(1., 0.2 * x[2], 0.2 * x[1]);
    J[1] = Point<3>(0., 1., 0.6 * x[2]);
    J[2] = Point<3>(0.4 * x[0] - 0.1 * x[1], -0.1 * x[0], 1.);
    return determinant(J);
  }

  /// A cube, a wedge on its right side, a tetrahedron on top of the wedge, with
  /// middles of edges, as Abaqus orders them.
  struct Deck
  {
    std::vector<Point<3>>                  vertices = {{0, 0, 0},
                                                       {1, 0, 0},
                                                       {1, 1, 0},
                                                       {0, 1, 0},
                                                       {0, 0, 1},
                                                       {1, 0, 1},
                                                       {1, 1, 1},
                                                       {0, 1, 1},
                                                       {2, 0, 0},
                                                       {2, 0, 1},
                                                       {1, 0, 2}};
    std::vector<std::vector<unsigned int>> cells    = {{1, 2, 3, 4, 5, 6, 7, 8},
                                                       {2, 9, 3, 6, 10, 7},
                                                       {6, 10, 7, 11}};
  };

  const std::vector<std::vector<std::array<unsigned int, 2>>> edges = {
    {{0, 1},
     {1, 2},
     {2, 3},
     {3, 0},
     {4, 5},
     {5, 6},
     {6, 7},
     {7, 4},
     {0, 4},
     {1, 5},
     {2, 6},
     {3, 7}},
    {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}},
    {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

  /// Of the bent cube, wedge and tetrahedron.
  inline double
  exact_volume()
  {
    double          sum = 0.;
    const QGauss<3> cube(3);
    for (unsigned int q = 0; q < cube.size(); ++q)
      sum += cube.weight(q) * bent_determinant(cube.point(q));
    const QGauss<3> collapsed(4);
    for (unsigned int q = 0; q < collapsed.size(); ++q)
      {
        // (s, t (1 - s)) in the triangle of the wedge
        const Point<3> &y = collapsed.point(q);
        sum += collapsed.weight(q) * (1. - y[0]) *
               bent_determinant({1. + y[0], y[1] * (1. - y[0]), y[2]});
      }
    const Quadrature<3> tetrahedron = mortise::simplex_quadrature<3>(8);
    for (unsigned int q = 0; q < tetrahedron.size(); ++q)
      sum += tetrahedron.weight(q) *
             bent_determinant(Point<3>(1., 0., 1.) +
                              Tensor<1, 3>(tetrahedron.point(q)));
    return sum;
  }

  inline double
  volume_of(const mortise::CoarseMesh &mesh)
  {
    const auto volumes = mortise::measure(mesh).volumes;
    return std::accumulate(volumes.begin(), volumes.end(), 0.);
  }
} // namespace three_shapes
