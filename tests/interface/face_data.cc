// Proves what a SurfaceFace derives from its points: derivatives, box, flags,
// normals, area, frame, the message for wrong input, and that it survives
// serialization.
#include <deal.II/base/utilities.h>

#include <mortise/base/error.h>

#include "synthetic_surface.h"

using namespace synthetic;

namespace
{
  void
  check_evaluation(const unsigned int degree)
  {
    const SurfaceFace face = faces(sphere(2.), {1, 1, degree})[0];
    FacePolynomial    polynomial;
    polynomial.reinit(face, face.frame.center);
    const double h = 1e-6;
    Lanes        xi_1, xi_2;
    const double at[n_lanes] = {0., 1., 0.3, 0.5, 0.71, 1.2, -0.1, 0.9};
    for (unsigned int l = 0; l < n_lanes; ++l)
      {
        xi_1[l] = at[l];
        xi_2[l] = at[(3 * l + 2) % n_lanes];
      }
    Vec3<Lanes> x, a, b, dx[2], ignored[2];
    polynomial.evaluate(xi_1, xi_2, x, dx);
    double derivative = 0, edge_error = 0;
    for (unsigned int i = 0; i < 2; ++i)
      {
        polynomial.evaluate(xi_1 + (i == 0 ? h : 0.),
                            xi_2 + (i == 1 ? h : 0.),
                            b,
                            ignored);
        polynomial.evaluate(xi_1 - (i == 0 ? h : 0.),
                            xi_2 - (i == 1 ? h : 0.),
                            a,
                            ignored);
        for (unsigned int d = 0; d < 3; ++d)
          derivative =
            std::max(derivative,
                     largest(absolute((b[d] - a[d]) / (2 * h) - dx[i][d])));
      }
    EdgePolynomial edges[4];
    unsigned int   edge[n_lanes];
    for (unsigned int k = 0; k < 4; ++k)
      edges[k].reinit(polynomial, face.shape, k);
    for (unsigned int l = 0; l < n_lanes; ++l)
      edge[l] = l % 4;
    evaluate_edges(edges, edge, xi_1, a, b);
    Lanes eta_1, eta_2;
    for (unsigned int l = 0; l < n_lanes; ++l)
      {
        const auto eta = edge_coordinates(face.shape, edge[l], at[l]);
        eta_1[l]       = eta[0];
        eta_2[l]       = eta[1];
      }
    polynomial.evaluate(eta_1, eta_2, x, dx);
    for (unsigned int d = 0; d < 3; ++d)
      edge_error = std::max(edge_error, largest(absolute(a[d] - x[d])));
    verdict("degree " + std::to_string(degree) +
              ", derivatives against differences",
            derivative,
            1e-7);
    verdict("degree " + std::to_string(degree) + ", edges against the face",
            edge_error,
            1e-13);
  }

  void
  check_geometry(const unsigned int degree)
  {
    const std::string name    = "degree " + std::to_string(degree);
    const auto        all     = faces(sphere(2.), {3, 2, degree});
    double            outside = 0, normal_error = 0, chart_error = 0;
    for (const auto &face : all)
      {
        for (unsigned int i = 0; i <= 20; ++i)
          for (unsigned int j = 0; j <= 20; ++j)
            {
              const Point<3> x = face_point(face, Point<2>(i / 20., j / 20.));
              for (unsigned int d = 0; d < 3; ++d)
                outside = std::max(
                  {outside, face.lower[d] - x[d], x[d] - face.upper[d]});
              for (unsigned int c = 0; c < 2; ++c)
                {
                  const double chart =
                    0.5 + face.frame.dual[c] * (x - face.frame.center);
                  chart_error = std::max({chart_error,
                                          face.frame.chart.lower[c] - chart,
                                          chart - face.frame.chart.upper[c]});
                }
            }
        for (unsigned int v = 0; v < 4; ++v)
          {
            const Point<3> x = face_point(face, Point<2>(v % 2, v / 2));
            normal_error =
              std::max(normal_error,
                       (face.vertex_normals[v] - x / x.norm()).norm());
          }
      }
    verdict(name + ", box contains the face", outside, 1e-14);
    verdict(name + ", chart box contains the face", chart_error, 1e-13);
    verdict(name + ", averaged normals of a sphere",
            normal_error,
            degree == 1 ? 0.25 : 0.05);
  }

  void
  check_flags()
  {
    // A parallelogram 1e-13 and 1e-10 of its size off, at three sizes.
    for (const double size : {1e-3, 1., 1e6})
      for (const double error : {1e-13, 1e-10})
        {
          SurfaceFace face;
          for (const Point<3> &x : {Point<3>(0, 0, 0),
                                    Point<3>(1, 0, 1),
                                    Point<3>(0.5, 1, 0),
                                    Point<3>(1.5, 1 + error, 1)})
            face.points.push_back(Point<3>(size * x));
          face.finalize();
          const bool expected = error < 1e-12;
          verdict("a parallelogram is recognised relative to its size",
                  face.affine == expected && face.linear == expected ? 0. : 1.,
                  0.);
        }
    double worst = 0;
    for (const auto &face : faces(plane(25.), {3, 2, 4}))
      worst = std::max(
        {worst,
         face.linear ? 0. : 1.,
         std::abs(face_area(face) - 1. / 6.),
         (face.frame.normal - face_normal(face, Point<2>(0.2, 0.7))).norm()});
    verdict("flat faces of degree 4: linear, area, normal", worst, 1e-14);
  }

  void
  check_area()
  {
    // The cube's sides projected to the sphere: six patches cover it.
    const Surface patch = [](const double u, const double v) {
      const double a = std::tan((u - 0.5) * 0.5 * M_PI),
                   b = std::tan((v - 0.5) * 0.5 * M_PI);
      const Point<3> p(1., a, b);
      return Point<3>(p / p.norm());
    };
    double area = 0;
    for (const auto &face : faces(patch, {8, 8, 8}))
      area += face_area(face);
    verdict("area of a sphere", std::abs(6 * area / (4 * M_PI) - 1), 1e-12);
  }

  std::string
  message_of(SurfaceFace face)
  {
    try
      {
        face.finalize();
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "";
  }

  void
  check_input()
  {
    const SurfaceFace good = faces(plane(), {1, 1, 2})[0];
    SurfaceFace       bad  = good;
    bad.points.pop_back();
    verdict("a missing point is named",
            message_of(bad).find("8 points") == std::string::npos,
            0);
    bad        = good;
    bad.degree = 9;
    verdict("degree 9 is refused",
            message_of(bad).find("1 to 8") == std::string::npos,
            0);
    bad = good;
    for (auto &point : bad.points)
      point = Point<3>(point[0], 0, 0);
    verdict("a face without area is refused",
            message_of(bad).find("no area") == std::string::npos,
            0);
    bad              = good;
    bad.points[3][1] = std::nan("");
    verdict("a coordinate that is not a number is refused",
            message_of(bad).find("finite") == std::string::npos,
            0);
  }

  void
  check_serialization()
  {
    SurfaceFace face = faces(sphere(), {2, 2, 3})[2];
    face.payload     = {'a', 'b', 'c'};
    face.owner       = 7;
    const SurfaceFace copy =
      dealii::Utilities::unpack<SurfaceFace>(dealii::Utilities::pack(face));
    const bool same =
      copy.points == face.points && copy.id == face.id && copy.owner == 7 &&
      copy.payload == face.payload && copy.degree == face.degree &&
      copy.orientation == face.orientation && copy.lower == face.lower &&
      copy.upper == face.upper && copy.affine == face.affine &&
      copy.vertex_normals == face.vertex_normals && copy.size == face.size &&
      copy.frame.dual == face.frame.dual &&
      copy.frame.center == face.frame.center &&
      copy.frame.chart.upper == face.frame.chart.upper &&
      copy.frame.height_upper == face.frame.height_upper;
    verdict("a face survives its journey", same ? 0 : 1, 0);
  }
} // namespace

int
main()
{
  for (unsigned int degree = 1; degree <= 8; ++degree)
    {
      check_evaluation(degree);
      check_geometry(degree);
    }
  check_flags();
  check_area();
  check_input();
  check_serialization();
  return 0;
}
