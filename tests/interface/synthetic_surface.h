// Surfaces for tests of the interface's geometry, built from functions (u,v)
// -> x without a mesh.
#pragma once

#include <mortise/interface/integration_cells.h>
#include <mortise/interface/surface_evaluation.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

#include "verdict.h"

namespace synthetic
{
  using namespace mortise;
  using dealii::Point;
  using dealii::Tensor;

  using ::verdict;

  using Surface = std::function<Point<3>(double, double)>;

  struct Grid
  {
    unsigned int n_u = 1, n_v = 1, degree = 1;
    double       u_0 = 0, u_1 = 1, v_0 = 0, v_1 = 1;
    double       orientation = 1; ///< of x_u x x_v against the outward normal
    bool   transposed = false; ///< reference coordinates of the faces swapped
    double distortion =
      0; ///< inner vertices move by up to this fraction of a cell
    /// Triangles: two per cell, with either diagonal and any of the three
    /// vertices first, at random.
    FaceShape shape = FaceShape::quadrilateral;
  };

  struct Pairing
  {
    FaceShape   slave, master;
    std::string name;
  };

  inline std::vector<Pairing>
  pairings()
  {
    constexpr FaceShape triangle      = FaceShape::triangle,
                        quadrilateral = FaceShape::quadrilateral;
    return {{quadrilateral, quadrilateral, "quad/quad"},
            {triangle, triangle, "tri/tri"},
            {triangle, quadrilateral, "tri/quad"},
            {quadrilateral, triangle, "quad/tri"}};
  }

  /// A number in [-1,1] that depends on i, j and k only.
  inline double
  noise(const unsigned int i, const unsigned int j, const unsigned int k)
  {
    std::uint64_t x = (i * 1000003u + j) * 1000003u + k + 1u;
    for (unsigned int round = 0; round < 3; ++round)
      x = (x ^ (x >> 29)) * 0x9E3779B97F4A7C15u;
    return (x >> 11) * 0x1p-52 - 1.;
  }

  /// The surface as faces of a grid in (u,v), vertex normals averaged,
  /// finalized.
  inline std::vector<SurfaceFace>
  faces(const Surface &surface, const Grid &grid)
  {
    const auto vertex = [&](const unsigned int i,
                            const unsigned int j,
                            const unsigned int k) {
      const bool free = k == 0 ? i > 0 && i < grid.n_u : j > 0 && j < grid.n_v;
      const double d  = free ? grid.distortion * noise(i, j, k) : 0.;
      return k == 0 ? grid.u_0 + (grid.u_1 - grid.u_0) * (i + d) / grid.n_u :
                      grid.v_0 + (grid.v_1 - grid.v_0) * (j + d) / grid.n_v;
    };
    std::vector<SurfaceFace>                  result;
    std::vector<std::array<std::uint64_t, 4>> vertices;
    // The face with these corners in the grid; the reference coordinates of a
    // triangle are affine in (u,v), those of a quadrilateral bilinear.
    const auto add = [&](std::vector<std::array<unsigned int, 2>> corner) {
      const bool triangle = corner.size() == 3;
      if (grid.transposed)
        std::swap(corner[1], corner[2]);
      const LagrangeBasis &basis = lagrange_basis(grid.degree);
      SurfaceFace          face;
      face.shape       = grid.shape;
      face.degree      = grid.degree;
      face.id          = result.size();
      face.orientation = grid.transposed ? -grid.orientation : grid.orientation;
      for (unsigned int b = 0; b <= grid.degree; ++b)
        for (unsigned int a = 0; a <= grid.degree; ++a)
          {
            const double s = basis.node[a], t = basis.node[b];
            double       uv[2];
            for (unsigned int k = 0; k < 2; ++k)
              {
                double x[4];
                for (unsigned int v = 0; v < corner.size(); ++v)
                  x[v] = vertex(corner[v][0], corner[v][1], k);
                uv[k] = triangle ? (1 - s - t) * x[0] + s * x[1] + t * x[2] :
                                   (1 - t) * ((1 - s) * x[0] + s * x[1]) +
                                     t * ((1 - s) * x[2] + s * x[3]);
              }
            face.points.push_back(surface(uv[0], uv[1]));
          }
      vertices.push_back({});
      for (unsigned int v = 0; v < corner.size(); ++v)
        vertices.back()[v] = corner[v][1] * (grid.n_u + 1) + corner[v][0];
      result.push_back(face);
    };
    for (unsigned int j = 0; j < grid.n_v; ++j)
      for (unsigned int i = 0; i < grid.n_u; ++i)
        if (grid.shape == FaceShape::quadrilateral)
          add({{{i, j}}, {{i + 1, j}}, {{i, j + 1}}, {{i + 1, j + 1}}});
        else
          {
            const std::array<unsigned int, 2> a{{i, j}}, b{{i + 1, j}},
              c{{i + 1, j + 1}}, d{{i, j + 1}};
            std::vector<std::array<unsigned int, 2>> halves[2] = {{a, b, c},
                                                                  {a, c, d}};
            if (noise(i, j, 2) > 0)
              {
                halves[0] = {a, b, d};
                halves[1] = {b, c, d};
              }
            for (unsigned int h = 0; h < 2; ++h)
              {
                const unsigned int first = 1.5 * (1 + noise(i, j, 3 + h));
                std::rotate(halves[h].begin(),
                            halves[h].begin() + first,
                            halves[h].end());
                add(halves[h]);
              }
          }
    average_vertex_normals(result, vertices);
    for (auto &face : result)
      face.finalize();
    return result;
  }

  /// The face with its vertices in another order: vertex v is the old one of
  /// number order[v]. Quadrilaterals keep what lies opposite.
  inline SurfaceFace
  reordered(const SurfaceFace &face, const std::vector<unsigned int> &order)
  {
    SurfaceFace          result = face;
    const LagrangeBasis &basis  = lagrange_basis(face.degree);
    const unsigned int   n      = face.degree + 1;
    const auto           corner = [&](const unsigned int v) {
      return Point<2>(order[v] % 2, order[v] / 2);
    };
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
        result.points[j * n + i] =
          face_point(face,
                     corner(0) + basis.node[i] * (corner(1) - corner(0)) +
                       basis.node[j] * (corner(2) - corner(0)));
    for (unsigned int v = 0; v < n_vertices(face.shape); ++v)
      result.vertex_normals[v] = face.vertex_normals[order[v]];
    const Tensor<1, 2> a = corner(1) - corner(0), b = corner(2) - corner(0);
    result.orientation *= a[0] * b[1] - a[1] * b[0];
    result.finalize();
    return result;
  }

  /// All orders of the vertices of a face but their own.
  inline std::vector<std::vector<unsigned int>>
  vertex_orders(const FaceShape shape)
  {
    if (shape == FaceShape::triangle)
      return {{0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    return {{0, 2, 1, 3},
            {1, 0, 3, 2},
            {1, 3, 0, 2},
            {2, 3, 0, 1},
            {3, 2, 1, 0},
            {2, 0, 3, 1},
            {3, 1, 2, 0}};
  }

  using Visitor = std::function<void(const SurfaceFace &,
                                     const SurfaceFace &,
                                     const PairResult &,
                                     const IntegrationPoints &)>;

  struct Total
  {
    Coverage sum;
    double worst = 0; ///< largest |covered - area| / area over the slave faces
  };

  /// Integrate all pairs of two surfaces.
  inline Total
  integrate(const std::vector<SurfaceFace> &slaves,
            const std::vector<SurfaceFace> &masters,
            const unsigned int              degree,
            const Visitor                  &visitor  = Visitor(),
            const unsigned int              n_points = 0,
            const SearchDistance           &distance = {})
  {
    FaceTree                  tree(masters, distance);
    PairIntegrator            integrator(distance);
    IntegrationPoints         points;
    std::vector<unsigned int> candidates;
    Total                     total;
    integrator.set_points_per_direction(n_points);
    for (const auto &slave : slaves)
      {
        Coverage face;
        integrator.reinit(slave);
        face.slave_area = integrator.slave_area();
        tree.candidates(slave, candidates);
        for (const unsigned int m : candidates)
          {
            const PairResult pair =
              integrator.integrate(masters[m], degree, degree, points);
            face.add(pair, points);
            if (visitor && pair.status == PairStatus::accepted)
              visitor(slave, masters[m], pair, points);
          }
        total.worst = std::max(total.worst,
                               std::abs(face.covered_area - face.slave_area) /
                                 face.slave_area);
        total.sum.add(face);
      }
    return total;
  }

  /// A flat rectangle [0,1]^2 turned about its centre by @p degrees, in a tilted plane.
  inline Surface
  plane(const double degrees = 0, const double offset = 0)
  {
    return [degrees, offset](const double u, const double v) {
      const double a = degrees * M_PI / 180., x = u - 0.5, y = v - 0.5;
      const double s = std::cos(a) * x - std::sin(a) * y + offset;
      const double t = std::sin(a) * x + std::cos(a) * y + 0.3 * offset;
      // orthonormal axes of a tilted plane
      return Point<3>(0.48 * s - 0.8 * t + 1.1,
                      0.6 * s + 0.3,
                      0.64 * s + 0.6 * t - 0.2);
    };
  }

  /// Patch of the unit sphere around (1,1,1) like one of three patches of an
  /// octant.
  inline Surface
  sphere(const double radius = 1.)
  {
    return [radius](const double u, const double v) {
      const double a = std::tan((u - 0.5) * 0.25 * M_PI),
                   b = std::tan((v - 0.5) * 0.25 * M_PI);
      const Point<3> p(1., a, b);
      return Point<3>(radius / p.norm() * p);
    };
  }

  /// Quarter of a cylinder of length 1.
  inline Surface
  cylinder(const double radius = 1.)
  {
    return [radius](const double u, const double v) {
      return Point<3>(radius * std::cos(0.5 * M_PI * u),
                      radius * std::sin(0.5 * M_PI * u),
                      v);
    };
  }
} // namespace synthetic
