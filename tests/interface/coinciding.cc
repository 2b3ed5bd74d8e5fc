// Proves that faces with the same points are found in any order of their
// vertices, that what they are integrated with is right on both faces and equal
// to what clipping finds, and that nothing else is taken for such a pair.
#include "synthetic_surface.h"

using namespace synthetic;

namespace
{
  SurfaceFace
  turned_over(SurfaceFace face)
  {
    face.orientation *= -1.;
    for (auto &normal : face.vertex_normals)
      normal *= -1.;
    face.finalize();
    return face;
  }

  /// Integrals of products of degree p of both reference coordinates.
  std::vector<double>
  moments(const IntegrationPoints &points, const unsigned int p)
  {
    std::vector<double> result;
    for (unsigned int i = 0; i <= p; ++i)
      for (unsigned int j = 0; i + j <= p; ++j)
        {
          double sum = 0.;
          for (unsigned int q = 0; q < points.size(); ++q)
            sum += points.weight[q] * std::pow(points.slave_xi[0][q], i) *
                   std::pow(points.slave_xi[1][q], p - i) *
                   std::pow(points.master_eta[0][q], j) *
                   std::pow(points.master_eta[1][q], p - i - j);
          result.push_back(sum);
        }
    return result;
  }

  void
  check(const std::string &name,
        const Surface     &surface,
        const Grid        &grid,
        const unsigned int p)
  {
    double       position = 0., area = 0., moment = 0.;
    unsigned int missed = 0, wrong = 0;
    for (const SurfaceFace &slave : faces(surface, grid))
      {
        PairIntegrator integrator;
        integrator.reinit(slave);
        IntegrationPoints points, clipped;
        auto              orders = vertex_orders(slave.shape);
        orders.push_back({0, 1, 2, 3});
        for (const auto &order : orders)
          {
            const SurfaceFace master = turned_over(reordered(slave, order));
            const auto        pair =
              integrator.integrate_coinciding(slave, master, p, p, points);
            if (!pair)
              {
                ++missed;
                continue;
              }
            for (unsigned int q = 0; q < points.size(); ++q)
              {
                const Point<2> eta(points.master_eta[0][q],
                                   points.master_eta[1][q]);
                const Point<3> x(points.slave_x[0][q],
                                 points.slave_x[1][q],
                                 points.slave_x[2][q]);
                position =
                  std::max(position,
                           (face_point(master, eta) - x).norm() / slave.size);
              }
            const double whole = face_area(slave);
            area = std::max(area, std::abs(pair->area / whole - 1.));
            integrator.integrate(master, p, p, clipped);
            const auto a = moments(points, p), b = moments(clipped, p);
            for (unsigned int k = 0; k < a.size(); ++k)
              moment = std::max(moment, std::abs(a[k] - b[k]) / whole);
            // the same normals, and one point elsewhere
            wrong += bool(integrator.integrate_coinciding(
              slave, reordered(slave, order), p, p, points));
            SurfaceFace moved = master;
            moved.points.back() += 1e-9 * slave.size * slave.frame.normal;
            if (slave.shape == FaceShape::triangle)
              moved.points.front() += 1e-9 * slave.size * slave.frame.normal;
            moved.finalize();
            wrong +=
              bool(integrator.integrate_coinciding(slave, moved, p, p, points));
          }
      }
    verdict(name + ": found", missed, 0.);
    verdict(name + ": none but these", wrong, 0.);
    verdict(name + ": same places", position, 1e-13);
    verdict(name + ": area", area, 1e-11);
    verdict(name + ": as clipped", moment, 2e-10);
  }
} // namespace

int
main()
{
  for (const FaceShape shape : {FaceShape::quadrilateral, FaceShape::triangle})
    {
      const std::string name =
        shape == FaceShape::triangle ? "triangles" : "quadrilaterals";
      Grid flat{3, 2, 1}, distorted{3, 3, 1}, curved{3, 2, 4};
      flat.shape = distorted.shape = curved.shape = shape;
      distorted.distortion                        = 0.2;
      check(name + ", flat", plane(), flat, 3);
      check(name + ", distorted", plane(), distorted, 2);
      check(name + ", sphere", sphere(), curved, 4);
    }
}
