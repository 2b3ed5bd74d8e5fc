// Proves that the points of the overlaps satisfy the rule x_m = x_s + gap n/|n|
// on both faces and integrate polynomials of both faces' reference coordinates
// over flat distorted and curved meshes of triangles and quadrilaterals.
#include <map>

#include "synthetic_surface.h"

using namespace synthetic;

namespace
{
  // Legendre polynomials of degree 0..p at x in [0,1].
  std::array<double, max_face_nodes>
  legendre(const unsigned int p, const double x)
  {
    std::array<double, max_face_nodes> result = {{1., 2 * x - 1}};
    for (unsigned int i = 1; i < p; ++i)
      result[i + 1] =
        ((2 * i + 1) * (2 * x - 1) * result[i] - i * result[i - 1]) / (i + 1);
    return result;
  }

  struct Moments
  {
    explicit Moments(const unsigned int p)
      : p(p)
      , values((p + 1) * (p + 1))
    {}

    void
    add(const double x, const double y, const double weight)
    {
      const auto a = legendre(p, x), b = legendre(p, y);
      for (unsigned int j = 0; j <= p; ++j)
        for (unsigned int i = 0; i <= p; ++i)
          values[j * (p + 1) + i] += weight * a[i] * b[j];
    }

    unsigned int        p;
    std::vector<double> values;
  };

  // Largest difference to the moments of the face by its own rule, relative to
  // its area.
  double
  error_of(const SurfaceFace &face, const Moments &moments)
  {
    Moments              exact(moments.p);
    FacePolynomial       polynomial;
    const ReferenceRule &rule = gauss_rule(24).on(face.shape);
    polynomial.reinit(face, face.frame.center);
    for (unsigned int q = 0; q < rule.weight.size(); ++q)
      {
        Vec3<Lanes> x, dx[2];
        polynomial.evaluate(broadcast(rule.xi_1[q]),
                            broadcast(rule.xi_2[q]),
                            x,
                            dx);
        const Vec3<Lanes> area = cross(dx[0], dx[1]);
        exact.add(rule.xi_1[q],
                  rule.xi_2[q],
                  std::sqrt(dot(area, area)[0]) * rule.weight[q]);
      }
    double result = 0;
    for (unsigned int i = 0; i < exact.values.size(); ++i)
      result = std::max(result,
                        std::abs(exact.values[i] - moments.values[i]) /
                          exact.values[0]);
    return result;
  }

  struct Errors
  {
    double slave = 0, master = 0, rule = 0, outside = 0;

    void
    add(const Errors &other)
    {
      slave   = std::max(slave, other.slave);
      master  = std::max(master, other.master);
      rule    = std::max(rule, other.rule);
      outside = std::max(outside, other.outside);
    }
  };

  // How far xi lies outside of the face, negative inside.
  double
  outside_by(const FaceShape shape, const Point<2> &xi)
  {
    const double there[2] = {xi[0], xi[1]};
    double       least    = 1.;
    for (const unsigned int side : sides_of(shape))
      least = std::min(least, inside_by(there, side));
    return -least;
  }

  // With n_points = 0 the points are chosen by quadrature_points().
  Errors
  errors_of(const std::vector<SurfaceFace> &slaves,
            const std::vector<SurfaceFace> &masters,
            const unsigned int              p,
            const unsigned int              n_points = 0)
  {
    Errors                           errors;
    std::map<std::uint64_t, Moments> slave_moments, master_moments;
    const auto                       visit = [&](const SurfaceFace &slave,
                           const SurfaceFace &master,
                           const PairResult &,
                           const IntegrationPoints &points) {
      Moments &on_slave =
        slave_moments.emplace(slave.id, Moments(p)).first->second;
      Moments &on_master =
        master_moments.emplace(master.id, Moments(p)).first->second;
      for (unsigned int q = 0; q < points.size(); ++q)
        {
          const Point<2> xi(points.slave_xi[0][q], points.slave_xi[1][q]);
          const Point<2> eta(points.master_eta[0][q], points.master_eta[1][q]);
          on_slave.add(xi[0], xi[1], points.weight[q]);
          on_master.add(eta[0], eta[1], points.weight[q]);
          Tensor<1, 3>   n = averaged_normal(slave, xi);
          const Point<3> x_s(points.slave_x[0][q],
                             points.slave_x[1][q],
                             points.slave_x[2][q]);
          const Point<3> x_m(points.master_x[0][q],
                             points.master_x[1][q],
                             points.master_x[2][q]);
          const double   size = std::min(slave.size, master.size);
          errors.rule = std::max(
            {errors.rule,
             (x_s - face_point(slave, xi)).norm() / size,
             (x_m - face_point(master, eta)).norm() / size,
             (x_m - x_s - points.gap[q] * n / n.norm()).norm() / size});
          errors.outside = std::max({errors.outside,
                                     outside_by(slave.shape, xi),
                                     outside_by(master.shape, eta) - 0.1});
        }
    };
    integrate(slaves, masters, p, visit, n_points);
    for (const auto &slave : slaves)
      errors.slave =
        std::max(errors.slave, error_of(slave, slave_moments.at(slave.id)));
    for (const auto &master : masters)
      if (master_moments.count(master.id) > 0)
        errors.master =
          std::max(errors.master,
                   error_of(master, master_moments.at(master.id)));
    return errors;
  }

  void
  check(const std::string &name,
        const Errors      &errors,
        const double       allowed,
        const bool         master)
  {
    verdict(name + ": moments on slave faces", errors.slave, allowed);
    if (master)
      verdict(name + ": moments on master faces", errors.master, allowed);
    verdict(name + ": points satisfy the rule", errors.rule, 1e-12);
    verdict(name + ": points lie on the faces", errors.outside, 1e-15);
  }
} // namespace

int
main()
{
  for (const Pairing &pairing : pairings())
    {
      const bool triangles = pairing.slave == FaceShape::triangle &&
                             pairing.master == FaceShape::triangle;
      for (const unsigned int p : {1u, 2u, 4u})
        for (const double distortion : {0., 0.05, 0.15})
          {
            Errors errors;
            for (const auto &n : std::vector<std::array<unsigned int, 2>>{
                   {{7, 5}}, {{5, 7}}, {{2, 20}}})
              errors.add(errors_of(faces(plane(),
                                         {n[0],
                                          n[0],
                                          1,
                                          0,
                                          1,
                                          0,
                                          1,
                                          1,
                                          false,
                                          distortion,
                                          pairing.slave}),
                                   faces(plane(),
                                         {n[1],
                                          n[1],
                                          1,
                                          0,
                                          1,
                                          0,
                                          1,
                                          -1,
                                          true,
                                          distortion,
                                          pairing.master}),
                                   p));
            // Distorted triangles are as affine as any.
            check(pairing.name + ", p=" + std::to_string(p) +
                    ", flat, 7:5, 5:7 and 2:20, distorted by " +
                    std::to_string(int(100 * distortion)) + " %",
                  errors,
                  distortion == 0 || triangles ? 1e-13 : 2e-10,
                  true);
          }
      // With points to spare nothing but rounding is left.
      check(
        pairing.name + ", p=2, flat, distorted by 20 %, 24 points",
        errors_of(
          faces(plane(), {6, 6, 1, 0, 1, 0, 1, 1, false, 0.2, pairing.slave}),
          faces(plane(), {5, 5, 1, 0, 1, 0, 1, -1, true, 0.2, pairing.master}),
          2,
          24),
        1e-13,
        true);

      // Curved: the slave's integrals (the master's are those of the slave's
      // surface).
      for (const unsigned int p : {1u, 2u, 3u, 4u, 6u, 8u})
        check(
          pairing.name + ", p=" + std::to_string(p) + ", sphere, 9:6",
          errors_of(
            faces(sphere(), {9, 9, p, 0, 1, 0, 1, 1, false, 0, pairing.slave}),
            faces(sphere(),
                  {6, 6, p, -.1, 1.1, -.1, 1.1, -1, true, 0, pairing.master}),
            p),
          2e-9,
          false);
    }
  return 0;
}
