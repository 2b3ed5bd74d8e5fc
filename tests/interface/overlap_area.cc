// Proves that the overlaps of non-matching surfaces cover each slave face
// exactly: triangles and quadrilaterals, flat and curved, any ratio, coincident
// and almost coincident edges, edges along the sides, slivers, distorted faces,
// partial overlap.
#include <algorithm>
#include <map>

#include "synthetic_surface.h"

using namespace synthetic;

namespace
{
  double
  worst_of(const Pairing &pairing,
           const Surface &slave,
           Grid           slave_grid,
           const Surface &master,
           Grid           master_grid)
  {
    slave_grid.shape        = pairing.slave;
    master_grid.shape       = pairing.master;
    master_grid.orientation = -1;
    master_grid.transposed  = true;
    const Total total =
      integrate(faces(slave, slave_grid),
                faces(master, master_grid),
                std::max(slave_grid.degree, master_grid.degree));
    return total.worst + total.sum.n_failures;
  }

  void
  check_flat(const Pairing &pairing)
  {
    double ratios = 0, turned = 0, shifted = 0;
    for (const auto &ratio :
         std::vector<std::array<unsigned int, 2>>{{{1, 1}},
                                                  {{5, 5}},
                                                  {{2, 3}},
                                                  {{7, 11}},
                                                  {{1, 20}},
                                                  {{20, 1}},
                                                  {{1, 50}},
                                                  {{50, 1}}})
      {
        ratios = std::max(ratios,
                          worst_of(pairing,
                                   plane(),
                                   {ratio[0], ratio[0]},
                                   plane(),
                                   {ratio[1], ratio[1]}));
        for (const double degrees : {1e-12, 20., 45.})
          turned = std::max(
            turned,
            worst_of(pairing,
                     plane(),
                     {ratio[0], ratio[0]},
                     plane(degrees),
                     {ratio[1], ratio[1], 1, -0.25, 1.25, -0.25, 1.25}));
      }
    // A master grid of the same cells moved by almost nothing, and slivers.
    for (const double shift : {1e-16, 1e-15, 1e-13, 1e-12, 1e-10, 1e-8, 1e-5})
      for (const double distortion : {0., 0.1})
        shifted = std::max(
          shifted,
          worst_of(pairing,
                   plane(),
                   {5, 5, 1, 0, 1, 0, 1, 1, false, distortion},
                   plane(0., shift),
                   {7, 7, 1, -0.2, 1.2, -0.2, 1.2, 1, false, distortion}));
    // The same distorted mesh on both sides: every edge has its twin.
    const double      matching = worst_of(pairing,
                                     plane(),
                                          {6, 5, 1, 0, 1, 0, 1, 1, false, 0.2},
                                     plane(),
                                          {6, 5, 1, 0, 1, 0, 1, 1, false, 0.2});
    const std::string name     = pairing.name + ", flat, ";
    verdict(name + "ratios 1:1 to 1:50: areas add up", ratios, 1e-12);
    verdict(name + "turned by 1e-12, 20 and 45 degrees", turned, 1e-12);
    verdict(name + "distorted and matching", matching, 1e-11);
    verdict(
      name +
        "shifted by 1e-16 to 1e-5 (distorted ones: quadrature of the cells)",
      shifted,
      1e-11);
  }

  void
  check_curved(const Pairing &pairing)
  {
    // The cylinder's rims are the same on both sides if the normal field is
    // radial, which that of a mesh of triangles is only roughly.
    const bool rims = pairing.slave == FaceShape::quadrilateral &&
                      pairing.master == FaceShape::quadrilateral;
    const double more          = rims ? 0. : 0.1;
    const auto   cylinder_grid = [&](const unsigned int n_u,
                                   const unsigned int n_v,
                                   const unsigned int g) {
      return Grid{n_u, n_v, g, -more, 1. + more, -more, 1. + more};
    };
    for (unsigned int g = 1; g <= 8; ++g)
      {
        double ratios = 0, extreme = 0;
        for (const auto &ratio : std::vector<std::array<unsigned int, 2>>{
               {{4, 6}}, {{6, 4}}, {{5, 5}}, {{7, 11}}})
          {
            ratios =
              std::max({ratios,
                        worst_of(pairing,
                                 sphere(),
                                 {ratio[0], ratio[0], g},
                                 sphere(),
                                 {ratio[1], ratio[1], g, -0.1, 1.1, -0.1, 1.1}),
                        worst_of(pairing,
                                 cylinder(),
                                 {ratio[0], 3, g},
                                 cylinder(),
                                 cylinder_grid(ratio[1], 2, g))});
          }
        const bool far_apart = g <= (rims ? 4u : 2u);
        if (far_apart)
          for (const auto &ratio :
               std::vector<std::array<unsigned int, 2>>{{{2, 100}}, {{100, 2}}})
            extreme = std::max(extreme,
                               worst_of(pairing,
                                        cylinder(),
                                        {ratio[0], ratio[0] / 2, g},
                                        cylinder(),
                                        cylinder_grid(ratio[1],
                                                      ratio[1] / 2,
                                                      std::min(g + 1, 8u))));
        const std::string name =
          pairing.name + ", curved, degree " + std::to_string(g);
        verdict(name + ", sphere and cylinder, ratios 2:3 to 7:11",
                ratios,
                1e-11);
        if (far_apart)
          verdict(name + ", 1:50 both ways", extreme, 1e-11);
      }
  }

  // A wavy surface on which edges of both meshes lie on common grid lines, as
  // different polynomials: they cross each other any number of times. Many
  // points, so that what is left is the clipper's.
  void
  check_wave(const Pairing &pairing)
  {
    const Surface wave = [](const double u, const double v) {
      return Point<3>(u, v, 0.15 * std::sin(5 * u) * std::cos(4 * v + 1));
    };
    for (const unsigned int g : {2u, 4u, 5u})
      {
        double worst = 0;
        for (const auto &ratio : std::vector<std::array<unsigned int, 2>>{
               {{2, 3}}, {{6, 6}}, {{20, 2}}})
          {
            Grid slave{ratio[0], ratio[0], g};
            Grid master{ratio[1], ratio[1], g, -.2, 1.2, -.2, 1.2, -1, true};
            slave.shape                            = pairing.slave;
            master.shape                           = pairing.master;
            const auto                      slaves = faces(wave, slave);
            std::map<std::uint64_t, double> covered;
            const auto                      note = [&](const auto &face,
                                  const auto &,
                                  const auto &pair,
                                  const auto &) {
              covered[face.id] += pair.area;
            };
            const Total total =
              integrate(slaves, faces(wave, master), g, note, 24);
            worst += total.sum.n_failures;
            for (const auto &face : slaves)
              worst =
                std::max(worst,
                         std::abs(covered[face.id] / face_area(face, 30) - 1.));
          }
        verdict(pairing.name + ", wave of degree " + std::to_string(g) +
                  ", edges on common lines",
                worst,
                1e-11);
      }
  }

  // A dome below a plane: partners lie along normals that are tilted, beyond
  // faces of the plane over the rims.
  void
  check_tilted(const Pairing &pairing)
  {
    const auto dome = [](const double curvature) -> Surface {
      return [curvature](const double u, const double v) {
        const double square = std::pow(u - 0.5, 2) + std::pow(v - 0.5, 2);
        return Point<3>(u, v, -0.02 - curvature * square);
      };
    };
    const Surface flat = [](const double u, const double v) {
      return Point<3>(u, v, 0.);
    };
    double worst = 0;
    for (const unsigned int degree : {1u, 2u, 4u})
      for (const auto &ratio :
           std::vector<std::array<unsigned int, 2>>{{{1, 40}},
                                                    {{2, 16}},
                                                    {{2, 77}},
                                                    {{4, 16}},
                                                    {{4, 23}},
                                                    {{4, 40}},
                                                    {{4, 50}},
                                                    {{17, 7}},
                                                    {{30, 2}},
                                                    {{30, 5}},
                                                    {{41, 3}}})
        worst =
          std::max(worst,
                   worst_of(pairing,
                            dome(ratio[0] < 4 ? 0.5 : 0.2),
                            {ratio[0], ratio[0], degree},
                            flat,
                            {ratio[1], ratio[1], 1, -0.5, 1.5, -0.5, 1.5}));
    verdict(pairing.name + ", a dome below a plane", worst, 1e-11);
  }

  // In the plane of plane(0): the corners of a flat face, counter-clockwise.
  using Polygon = std::vector<Point<2>>;

  double
  signed_area(const Polygon &polygon)
  {
    double result = 0;
    for (unsigned int i = 0; i < polygon.size(); ++i)
      {
        const auto &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        result += 0.5 * (p[0] * q[1] - p[1] * q[0]);
      }
    return result;
  }

  Polygon
  corners(const SurfaceFace &face)
  {
    Polygon            result;
    const unsigned int n = n_vertices(face.shape);
    for (unsigned int i = 0; i < n; ++i)
      {
        const auto         xi = edge_coordinates(face.shape, i, 0.);
        const Tensor<1, 3> x =
          face_point(face, Point<2>(xi[0], xi[1])) - Point<3>(1.1, 0.3, -0.2);
        result.emplace_back(0.48 * x[0] + 0.6 * x[1] + 0.64 * x[2],
                            -0.8 * x[0] + 0.6 * x[2]);
      }
    if (signed_area(result) < 0)
      std::reverse(result.begin(), result.end());
    return result;
  }

  // Area of the overlap of two convex polygons, in the plane.
  double
  exact_overlap(Polygon subject, const Polygon &window)
  {
    for (unsigned int e = 0; e < window.size(); ++e)
      {
        const auto &a = window[e], &b = window[(e + 1) % window.size()];
        const auto  left = [&](const Point<2> &p) {
          return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
        };
        Polygon result;
        for (unsigned int i = 0; i < subject.size(); ++i)
          {
            const auto  &p = subject[i], &q = subject[(i + 1) % subject.size()];
            const double f = left(p), g = left(q);
            if (f >= 0)
              result.push_back(p);
            if (f * g < 0)
              result.push_back(p + f / (f - g) * (q - p));
          }
        subject = result;
      }
    return subject.empty() ? 0. : signed_area(subject);
  }

  // Every single pair of two meshes of triangles or general convex
  // quadrilaterals against polygons.
  void
  check_pairs(const Pairing     &pairing,
              const unsigned int n_slave,
              const unsigned int n_master,
              const double       distortion)
  {
    const auto slaves = faces(
      plane(),
      {n_slave, n_slave, 1, 0, 1, 0, 1, 1, false, distortion, pairing.slave});
    const auto masters = faces(plane(20.),
                               {n_master,
                                n_master,
                                1,
                                -.25,
                                1.25,
                                -.25,
                                1.25,
                                -1,
                                true,
                                distortion,
                                pairing.master});
    std::map<std::pair<unsigned int, unsigned int>, double> areas;
    const auto note = [&](const auto &slave,
                          const auto &master,
                          const auto &pair,
                          const auto &) {
      areas[{slave.id, master.id}] = pair.area;
    };
    integrate(slaves, masters, 1, note, 20);
    double worst = 0;
    for (const auto &slave : slaves)
      for (const auto &master : masters)
        {
          const double exact  = exact_overlap(corners(slave), corners(master));
          const auto   stored = areas.find({slave.id, master.id});
          const double got    = stored == areas.end() ? 0. : stored->second;
          worst = std::max(worst, std::abs(got - exact) / face_area(slave));
        }
    verdict(pairing.name + ", distorted by " +
              std::to_string(int(100 * distortion)) + " %, " +
              std::to_string(n_slave) + ":" + std::to_string(n_master) +
              ": every pair against the overlap of polygons",
            worst,
            1e-11);
  }

  void
  check_partial(const Pairing &pairing)
  {
    // A master patch in the middle of the slaves, turned: all of it is found,
    // and no more.
    Grid grid{3, 3, 1, 0.3, 0.7, 0.25, 0.65}, slave_grid{5, 5};
    grid.orientation = -1;
    grid.shape       = pairing.master;
    slave_grid.shape = pairing.slave;
    const Total total =
      integrate(faces(plane(), slave_grid), faces(plane(33.), grid), 1);
    verdict(pairing.name + ", partial overlap, flat",
            std::abs(total.sum.covered_area / 0.16 - 1.),
            1e-13);

    // A strip of one cylinder whose rims lie in planes: exact where the slave
    // is straight along the cylinder and its normals are radial.
    Grid strip{4, 3, 4, 0., 1., 0.21, 0.77}, whole{4, 5, 4};
    strip.orientation = -1;
    strip.shape       = pairing.master;
    whole.shape       = pairing.slave;
    const auto slaves = faces(cylinder(), whole);
    if (pairing.slave == FaceShape::quadrilateral)
      {
        const Total partly = integrate(slaves, faces(cylinder(), strip), 4);
        verdict(pairing.name + ", partial overlap, cylinder",
                std::abs(partly.sum.covered_area /
                           (0.56 * partly.sum.slave_area) -
                         1.),
                1e-12);
      }
    const Total none = integrate(slaves, faces(cylinder(0.2), strip), 4);
    verdict(pairing.name + ", nothing is found where nothing is near",
            none.sum.covered_area,
            0.);
  }
} // namespace

int
main()
{
  for (const Pairing &pairing : pairings())
    {
      check_flat(pairing);
      check_curved(pairing);
      check_wave(pairing);
      check_pairs(pairing, 7, 5, 0.1);
      check_pairs(pairing, 7, 5, 0.3);
      check_pairs(pairing, 2, 30, 0.25);
      check_pairs(pairing, 30, 2, 0.25);
      check_partial(pairing);
      check_tilted(pairing);
    }
  return 0;
}
