// Proves that the overlaps of non-matching surfaces cover each slave face
// exactly: flat and curved, any ratio, coincident and almost coincident edges,
// slivers, distorted faces, partial overlap.
#include <algorithm>
#include <map>

#include "synthetic_surface.h"

using namespace synthetic;

namespace
{
  double
  worst_of(const Surface &slave,
           const Grid    &slave_grid,
           const Surface &master,
           Grid           master_grid)
  {
    master_grid.orientation = -1;
    master_grid.transposed  = true;
    const Total total =
      integrate(faces(slave, slave_grid),
                faces(master, master_grid),
                std::max(slave_grid.degree, master_grid.degree));
    return total.worst + total.sum.n_failures;
  }

  void
  check_flat()
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
                          worst_of(plane(),
                                   {ratio[0], ratio[0]},
                                   plane(),
                                   {ratio[1], ratio[1]}));
        for (const double degrees : {1e-12, 20., 45.})
          turned = std::max(
            turned,
            worst_of(plane(),
                     {ratio[0], ratio[0]},
                     plane(degrees),
                     {ratio[1], ratio[1], 1, -0.25, 1.25, -0.25, 1.25}));
      }
    // A master grid of the same cells moved by almost nothing, and slivers.
    for (const double shift : {1e-16, 1e-15, 1e-13, 1e-12, 1e-10, 1e-8, 1e-5})
      for (const double distortion : {0., 0.1})
        shifted = std::max(
          shifted,
          worst_of(plane(),
                   {5, 5, 1, 0, 1, 0, 1, 1, false, distortion},
                   plane(0., shift),
                   {7, 7, 1, -0.2, 1.2, -0.2, 1.2, 1, false, distortion}));
    verdict("flat, ratios 1:1 to 1:50: areas add up", ratios, 1e-12);
    verdict("flat, turned by 1e-12, 20 and 45 degrees", turned, 1e-12);
    verdict(
      "flat, shifted by 1e-16 to 1e-5 (distorted ones: quadrature of the cells)",
      shifted,
      1e-11);
  }

  void
  check_curved()
  {
    for (unsigned int g = 1; g <= 8; ++g)
      {
        double ratios = 0, extreme = 0;
        for (const auto &ratio : std::vector<std::array<unsigned int, 2>>{
               {{4, 6}}, {{6, 4}}, {{5, 5}}, {{7, 11}}})
          {
            // The sphere's masters reach beyond the slaves; the cylinder's rims
            // are the same.
            ratios = std::max(
              {ratios,
               worst_of(sphere(),
                        {ratio[0], ratio[0], g},
                        sphere(),
                        {ratio[1], ratio[1], g, -0.1, 1.1, -0.1, 1.1}),
               worst_of(
                 cylinder(), {ratio[0], 3, g}, cylinder(), {ratio[1], 2, g})});
          }
        if (g <= 4)
          for (const auto &ratio :
               std::vector<std::array<unsigned int, 2>>{{{2, 100}}, {{100, 2}}})
            extreme =
              std::max(extreme,
                       worst_of(cylinder(),
                                {ratio[0], ratio[0] / 2, g},
                                cylinder(),
                                {ratio[1], ratio[1] / 2, std::min(g + 1, 8u)}));
        const std::string name = "curved, degree " + std::to_string(g);
        verdict(name + ", sphere and cylinder, ratios 2:3 to 7:11",
                ratios,
                1e-11);
        if (g <= 4)
          verdict(name + ", 1:50 both ways", extreme, 1e-11);
      }
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
    const unsigned int n = face.degree + 1;
    for (const unsigned int i : {0u, n - 1, n * n - 1, n * (n - 1)})
      {
        const Tensor<1, 3> x = face.points[i] - Point<3>(1.1, 0.3, -0.2);
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

  // Every single pair of two meshes of general convex quadrilaterals against
  // polygons.
  void
  check_pairs(const unsigned int n_slave,
              const unsigned int n_master,
              const double       distortion)
  {
    const auto slaves =
      faces(plane(), {n_slave, n_slave, 1, 0, 1, 0, 1, 1, false, distortion});
    const auto masters = faces(
      plane(20.),
      {n_master, n_master, 1, -.25, 1.25, -.25, 1.25, -1, true, distortion});
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
    verdict("distorted by " + std::to_string(int(100 * distortion)) + " %, " +
              std::to_string(n_slave) + ":" + std::to_string(n_master) +
              ": every pair against the overlap of polygons",
            worst,
            1e-11);
  }

  void
  check_partial()
  {
    // A master patch in the middle of the slaves, turned: all of it is found,
    // and no more.
    Grid grid{3, 3, 1, 0.3, 0.7, 0.25, 0.65};
    grid.orientation = -1;
    const Total total =
      integrate(faces(plane(), {5, 5}), faces(plane(33.), grid), 1);
    verdict("partial overlap, flat",
            std::abs(total.sum.covered_area / 0.16 - 1.),
            1e-13);

    // The same strip of one cylinder, of equal geometry in the direction
    // around.
    Grid strip{4, 3, 4, 0., 1., 0.21, 0.77};
    strip.orientation  = -1;
    const auto  slaves = faces(cylinder(), {4, 5, 4});
    const Total partly = integrate(slaves, faces(cylinder(), strip), 4);
    verdict("partial overlap, cylinder",
            std::abs(partly.sum.covered_area / (0.56 * partly.sum.slave_area) -
                     1.),
            1e-12);
    const Total none = integrate(slaves, faces(cylinder(0.2), strip), 4);
    verdict("nothing is found where nothing is near",
            none.sum.covered_area,
            0.);
  }
} // namespace

int
main()
{
  check_flat();
  check_curved();
  check_pairs(7, 5, 0.1);
  check_pairs(7, 5, 0.3);
  check_pairs(2, 30, 0.25);
  check_pairs(30, 2, 0.25);
  check_partial();
  return 0;
}
