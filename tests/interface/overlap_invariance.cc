// Proves that the numbers do not depend on the scene's unit, place or turn, on
// the order of a face's vertices or on the choice of the slave, and that pairs
// are accepted by distance and normals as documented.
#include "synthetic_surface.h"

using namespace synthetic;

namespace
{
  // Area and the integral of quadratic functions of both faces' reference
  // coordinates, pair by pair, relative to the slave face.
  struct Signature
  {
    std::vector<double> values;
  };

  /// Area and the integral of @p function of the points, pair by pair,
  /// relative to the slave face.
  template <typename Function>
  Signature
  pair_integrals(const std::vector<SurfaceFace> &slaves,
                 const std::vector<SurfaceFace> &masters,
                 const Function                 &function)
  {
    Signature  result;
    const auto visit = [&](const SurfaceFace       &slave,
                           const SurfaceFace       &master,
                           const PairResult        &pair,
                           const IntegrationPoints &points) {
      double sum = 0;
      for (unsigned int q = 0; q < points.size(); ++q)
        sum += points.weight[q] * function(points, q);
      const double area = face_area(slave);
      // Slivers of rounding may come and go: they count for nothing.
      if (pair.area > 1e-10 * area)
        for (const double value : {double(slave.id),
                                   double(master.id),
                                   pair.area / area,
                                   sum / area})
          result.values.push_back(value);
    };
    integrate(slaves, masters, 2, visit);
    return result;
  }

  /// By the reference coordinates in both faces.
  Signature
  signature(const std::vector<SurfaceFace> &slaves,
            const std::vector<SurfaceFace> &masters)
  {
    return pair_integrals(
      slaves, masters, [](const IntegrationPoints &points, unsigned int q) {
        const double x = points.slave_xi[0][q], y = points.slave_xi[1][q];
        const double s = points.master_eta[0][q], t = points.master_eta[1][q];
        return (x * x + 2 * y - x * y) * (1 + s - t * t);
      });
  }

  double
  difference(const Signature &a, const Signature &b)
  {
    if (a.values.empty() || a.values.size() != b.values.size())
      return 1e10;
    double result = 0;
    for (unsigned int i = 0; i < a.values.size(); ++i)
      result = std::max(result, std::abs(a.values[i] - b.values[i]));
    return result;
  }

  Surface
  moved(const Surface &surface, const double scale, const Tensor<1, 3> &shift)
  {
    return [=](const double u, const double v) {
      return Point<3>(scale * surface(u, v)) + scale * shift;
    };
  }

  void
  check_units(const Pairing     &pairing,
              const std::string &case_name,
              const Surface     &slave,
              const Surface     &master,
              Grid               grid)
  {
    const std::string name        = pairing.name + ", " + case_name;
    Grid              master_grid = grid;
    grid.shape                    = pairing.slave;
    master_grid.shape             = pairing.master;
    master_grid.n_u               = 5;
    master_grid.n_v               = 4;
    master_grid.orientation       = -1;
    const Signature base =
      signature(faces(slave, grid), faces(master, master_grid));
    for (const double scale : {1e-3, 1e6})
      {
        const Tensor<1, 3> none;
        const Signature    other =
          signature(faces(moved(slave, scale, none), grid),
                    faces(moved(master, scale, none), master_grid));
        verdict(name + ", lengths times " + (scale < 1 ? "1e-3" : "1e6"),
                difference(base, other),
                // Where rounding decides on one more point, the rule's own
                // accuracy shows.
                grid.degree == 1 ? 1e-12 : 2e-11);
      }
    const Tensor<1, 3> far({1000., -700., 1200.});
    const Signature    other =
      signature(faces(moved(slave, 1., far), grid),
                faces(moved(master, 1., far), master_grid));
    verdict(name + ", moved by 1e3 diameters", difference(base, other), 1e-9);
  }

  /// By the places on both faces.
  Signature
  signature_in_space(const std::vector<SurfaceFace> &slaves,
                     const std::vector<SurfaceFace> &masters)
  {
    return pair_integrals(
      slaves, masters, [](const IntegrationPoints &points, unsigned int q) {
        return points.slave_x[0][q] * points.master_x[1][q] +
               points.slave_x[2][q] * (1 - points.master_x[2][q]) +
               points.gap[q];
      });
  }

  void
  check_order(const Pairing     &pairing,
              const std::string &case_name,
              const Surface     &slave,
              const Surface     &master,
              Grid               grid)
  {
    Grid master_grid{5, 4, grid.degree};
    master_grid.orientation = -1;
    master_grid.distortion  = grid.distortion;
    master_grid.shape       = pairing.master;
    grid.shape              = pairing.slave;
    const auto slaves       = faces(slave, grid),
               masters      = faces(master, master_grid);
    const Signature base    = signature_in_space(slaves, masters);

    const auto another = [&](std::vector<SurfaceFace> all,
                             const unsigned int       k) {
      for (SurfaceFace &face : all)
        face = reordered(face, vertex_orders(face.shape)[k]);
      return all;
    };
    double of_slave = 0, of_master = 0;
    for (unsigned int k = 0; k < vertex_orders(FaceShape::triangle).size(); ++k)
      {
        of_slave =
          std::max(of_slave,
                   difference(base,
                              signature_in_space(another(slaves, k), masters)));
        of_master =
          std::max(of_master,
                   difference(base,
                              signature_in_space(slaves, another(masters, k))));
      }
    // Where the maps are not linear the rule's own accuracy shows.
    const bool triangles = pairing.slave == FaceShape::triangle &&
                           pairing.master == FaceShape::triangle;
    const double allowed =
      grid.degree == 1 && (grid.distortion == 0 || triangles) ? 1e-12 : 2e-10;
    const std::string name =
      pairing.name + ", " + case_name + ", vertices in another order: ";
    verdict(name + "slaves", of_slave, allowed);
    verdict(name + "masters", of_master, allowed);
  }

  void
  check_exchange(const Pairing &pairing)
  {
    for (const unsigned int g : {1u, 2u, 4u})
      {
        // Curved surfaces of triangles cover each other's rims only roughly.
        if (g > 1 && (pairing.slave == FaceShape::triangle ||
                      pairing.master == FaceShape::triangle))
          continue;
        Grid a{6, 5, g}, b{4, 7, g};
        a.shape = pairing.slave;
        b.shape = pairing.master;
        for (Grid *grid : {&a, &b})
          grid->distortion = g == 1 ? 0.1 : 0.;
        const auto one = [&](const bool exchanged) {
          Grid slave = exchanged ? b : a, master = exchanged ? a : b;
          slave.orientation  = exchanged ? -1 : 1;
          master.orientation = exchanged ? 1 : -1;
          // The cylinder's rims are the same on both sides.
          const Surface surface = g == 1 ? plane() : cylinder();
          return integrate(faces(surface, slave), faces(surface, master), g);
        };
        const Total  there = one(false), back = one(true);
        const double difference =
          std::abs(there.sum.covered_area - back.sum.covered_area) /
          there.sum.covered_area;
        const std::string name = pairing.name + ", degree " +
                                 std::to_string(g) +
                                 ", slave and master exchanged";
        verdict(name + ": coverage", std::max(there.worst, back.worst), 1e-11);
        verdict(name + ": pairs",
                there.sum.n_pairs > back.sum.n_pairs ?
                  there.sum.n_pairs - back.sum.n_pairs :
                  back.sum.n_pairs - there.sum.n_pairs,
                g == 1 ? 0 : 12);
        // Areas of the two polynomial surfaces differ like their distance.
        verdict(name + ": area",
                difference,
                g == 1 ? 1e-13 :
                g == 2 ? 2e-4 :
                         1e-7);
      }
  }

  // Two concentric patches at a distance of `gap` face sizes; both of 4 x 4
  // faces.
  Total
  with_gap(const Pairing     &pairing,
           const double       gap,
           const double       orientation,
           const unsigned int degree)
  {
    Grid slave{4, 4, degree};
    slave.shape         = pairing.slave;
    const auto   slaves = faces(sphere(), slave);
    const double size   = slaves[5].size;
    Grid         grid{5, 5, degree, -0.3, 1.3, -0.3, 1.3, orientation};
    grid.shape = pairing.master;
    Total total =
      integrate(slaves, faces(sphere(1. + gap * size), grid), degree);
    total.sum.max_gap /= size;
    return total;
  }

  void
  check_acceptance(const Pairing &pairing)
  {
    const std::string name = pairing.name + ", ";
    // A quadratic with third derivative 1 along an edge of length h is off by
    // up to h^3 / (72 sqrt 3): the diagonals of the slaves (0.34) and masters
    // (0.44) together by 3e-3 of a slave's; without diagonals a third of that.
    const bool diagonals = pairing.slave == FaceShape::triangle ||
                           pairing.master == FaceShape::triangle;
    const double off_sphere = diagonals ? 3e-3 : 1e-3;
    for (const unsigned int degree : {2u, 4u})
      for (const double gap : {-0.4, -0.1, 0., 0.1, 0.4})
        {
          const Total total = with_gap(pairing, gap, -1., degree);
          verdict(name + "degree " + std::to_string(degree) + ", gap of " +
                    std::to_string(gap).substr(0, 4) + " face sizes: covered",
                  total.worst + total.sum.n_failures,
                  1e-10);
          verdict(name + "degree " + std::to_string(degree) + ", gap of " +
                    std::to_string(gap).substr(0, 4) + " face sizes: its size",
                  std::abs(total.sum.max_gap - std::abs(gap)),
                  off_sphere);
        }
    for (const double gap : {-1.2, 1.2})
      verdict(name + "beyond the search fraction nothing is accepted",
              with_gap(pairing, gap, -1., 3).sum.covered_area,
              0.);
    for (const double gap : {-0.1, 0., 0.1})
      {
        const Total total = with_gap(pairing, gap, 1., 3);
        verdict(name + "normals that agree: nothing is accepted, nothing fails",
                total.sum.covered_area + total.sum.n_failures,
                0.);
      }
    // A kink of 30 degrees between two flat halves, masters shifted across it.
    const Surface kink = [](const double u, const double v) {
      const double s = std::abs(u - 0.5);
      return Point<3>(u, v, std::tan(M_PI / 12.) * s);
    };
    Grid master{6, 5}, slave{4, 4};
    master.orientation = -1;
    master.shape       = pairing.master;
    slave.shape        = pairing.slave;
    verdict(name + "a kink in the surface: covered",
            integrate(faces(kink, slave), faces(kink, master), 1).worst,
            1e-10);
  }
} // namespace

int
main()
{
  for (const Pairing &pairing : pairings())
    {
      const Grid distorted{7, 6, 1, 0, 1, 0, 1, 1, false, 0.1};
      check_units(pairing, "flat", plane(), plane(20.), {7, 7});
      check_units(pairing, "flat, distorted", plane(), plane(), distorted);
      check_units(pairing, "sphere", sphere(), sphere(1.003), {7, 6, 3});
      check_order(pairing, "flat", plane(), plane(20.), {7, 7});
      check_order(pairing, "flat, distorted", plane(), plane(), distorted);
      check_order(pairing, "sphere", sphere(), sphere(1.003), {7, 6, 5});
      check_exchange(pairing);
      check_acceptance(pairing);
    }
  return 0;
}
