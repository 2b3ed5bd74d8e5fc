// Proves what a SurfaceFace, triangle or quadrilateral, derives from its
// points: derivatives, box, flags, normals, area, frame, a triangle's
// continuation, the message for wrong input, and that it survives
// serialization.
#include <deal.II/base/utilities.h>

#include <mortise/base/error.h>

#include "synthetic_surface.h"

using namespace synthetic;

namespace
{
  std::string
  name_of(const FaceShape shape)
  {
    return shape == FaceShape::triangle ? "triangle of " : "";
  }

  Grid
  grid_of(const FaceShape    shape,
          const unsigned int n_u,
          const unsigned int n_v,
          const unsigned int degree)
  {
    Grid grid{n_u, n_v, degree};
    grid.shape = shape;
    return grid;
  }

  void
  check_evaluation(const FaceShape shape, const unsigned int degree)
  {
    const std::string name =
      name_of(shape) + "degree " + std::to_string(degree);
    const SurfaceFace face = faces(sphere(2.), grid_of(shape, 1, 1, degree))[0];
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
    for (unsigned int k = 0; k < n_vertices(shape); ++k)
      edges[k].reinit(polynomial, face.shape, k);
    for (unsigned int l = 0; l < n_lanes; ++l)
      edge[l] = l % n_vertices(shape);
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
    verdict(name + ", derivatives against differences", derivative, 1e-7);
    verdict(name + ", edges against the face", edge_error, 1e-13);
  }

  void
  check_geometry(const FaceShape shape, const unsigned int degree)
  {
    const std::string name =
      name_of(shape) + "degree " + std::to_string(degree);
    const bool triangle = shape == FaceShape::triangle;
    const auto all      = faces(sphere(2.), grid_of(shape, 3, 2, degree));
    double     outside = 0, normal_error = 0, chart_error = 0;
    for (const auto &face : all)
      {
        for (unsigned int i = 0; i <= 20; ++i)
          for (unsigned int j = 0; j <= 20; ++j)
            {
              const double   along = triangle ? 1. - j / 20. : 1.;
              const Point<3> x =
                face_point(face, Point<2>(along * i / 20., j / 20.));
              for (unsigned int d = 0; d < 3; ++d)
                outside = std::max(
                  {outside, face.lower[d] - x[d], x[d] - face.upper[d]});
              double chart[2];
              for (unsigned int c = 0; c < 2; ++c)
                {
                  chart[c] = face.frame.center_xi +
                             face.frame.dual[c] * (x - face.frame.center);
                  chart_error =
                    std::max({chart_error,
                              face.frame.chart.lower[c] - chart[c],
                              chart[c] - face.frame.chart.upper[c]});
                }
              chart_error =
                std::max(chart_error,
                         chart[0] + chart[1] - face.frame.chart.upper[2]);
            }
        for (unsigned int v = 0; v < n_vertices(shape); ++v)
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

  // A flat triangle of degree 2 with the middle of its hypotenuse off by 1e-13
  // and 1e-10 of its size, and the continuation of a cubic.
  void
  check_triangle()
  {
    for (const double size : {1e-3, 1., 1e6})
      for (const double error : {1e-13, 1e-10})
        {
          SurfaceFace face =
            faces(plane(), grid_of(FaceShape::triangle, 1, 1, 2))[0];
          for (auto &point : face.points)
            point = Point<3>(size * point);
          face.points[4] += size * error * Point<3>(0, 0, 1);
          face.vertex_normals = {};
          face.finalize();
          verdict("a flat triangle is recognised relative to its size",
                  face.affine == (error < 1e-12) && face.linear == face.affine ?
                    0. :
                    1.,
                  0.);
        }

    const Surface cubic = [](const double u, const double v) {
      return Point<3>(u + v * v,
                      v - u * v * (1 - u),
                      u * u * u - 2 * u * v + v);
    };
    for (const unsigned int degree : {3u, 5u, 8u})
      {
        SurfaceFace face;
        face.shape                 = FaceShape::triangle;
        face.degree                = degree;
        const LagrangeBasis &basis = lagrange_basis(degree);
        // Points beyond the hypotenuse are not read.
        for (unsigned int j = 0; j <= degree; ++j)
          for (unsigned int i = 0; i <= degree; ++i)
            face.points.push_back(i + j <= degree ?
                                    cubic(basis.node[i], basis.node[j]) :
                                    Point<3>(7, 7, 7));
        face.finalize();
        double inside = 0, beyond = 0;
        for (unsigned int i = 0; i <= 10; ++i)
          for (unsigned int j = 0; j <= 10; ++j)
            {
              const double u = i / 10., v = j / 10.;
              double      &worst = i + j <= 10 ? inside : beyond;
              worst              = std::max(
                worst, (face_point(face, Point<2>(u, v)) - cubic(u, v)).norm());
            }
        const std::string name =
          "a cubic as triangle of degree " + std::to_string(degree) + ", ";
        verdict(name + "inside", inside, 2e-14);
        // Rounding of points in the triangle is amplified by the Lebesgue
        // constant at (1,1): 1e2, 4e3, 1.1e6.
        verdict(name + "continued",
                beyond,
                degree == 3 ? 1e-13 :
                degree == 5 ? 2e-12 :
                              5e-10);
      }
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
    for (const FaceShape shape :
         {FaceShape::quadrilateral, FaceShape::triangle})
      {
        double area = 0;
        for (const auto &face : faces(patch, grid_of(shape, 8, 8, 8)))
          area += face_area(face);
        verdict(name_of(shape) + "degree 8, area of a sphere",
                std::abs(6 * area / (4 * M_PI) - 1),
                1e-12);
      }
  }

  void
  check_input()
  {
    const SurfaceFace good     = faces(plane(), {1, 1, 2})[0];
    SurfaceFace       bad      = good;
    const auto        finalize = [&bad] { SurfaceFace(bad).finalize(); };
    bad.points.pop_back();
    check_message("a missing point is named", finalize, {"8 points"});
    bad        = good;
    bad.degree = 9;
    check_message("degree 9 is refused", finalize, {"1 to 8"});
    bad = good;
    for (auto &point : bad.points)
      point = Point<3>(point[0], 0, 0);
    check_message("a face without area is refused", finalize, {"no area"});
    bad              = good;
    bad.points[3][1] = std::nan("");
    check_message("a coordinate that is not a number is refused",
                  finalize,
                  {"finite"});
  }

  void
  check_serialization(const FaceShape shape)
  {
    SurfaceFace face = faces(sphere(), grid_of(shape, 2, 2, 3))[2];
    face.payload     = {'a', 'b', 'c'};
    face.owner       = 7;
    const SurfaceFace copy =
      dealii::Utilities::unpack<SurfaceFace>(dealii::Utilities::pack(face));
    const bool same =
      copy.points == face.points && copy.id == face.id && copy.owner == 7 &&
      copy.payload == face.payload && copy.degree == face.degree &&
      copy.shape == shape && copy.orientation == face.orientation &&
      copy.lower == face.lower && copy.upper == face.upper &&
      copy.affine == face.affine &&
      copy.vertex_normals == face.vertex_normals && copy.size == face.size &&
      copy.frame.dual == face.frame.dual &&
      copy.frame.center == face.frame.center &&
      copy.frame.chart.upper == face.frame.chart.upper &&
      copy.frame.chart.lower == face.frame.chart.lower &&
      copy.frame.center_xi == face.frame.center_xi &&
      copy.frame.height_upper == face.frame.height_upper;
    verdict("a face survives its journey", same ? 0 : 1, 0);
  }
} // namespace

int
main()
{
  for (const FaceShape shape : {FaceShape::quadrilateral, FaceShape::triangle})
    {
      for (unsigned int degree = 1; degree <= 8; ++degree)
        {
          check_evaluation(shape, degree);
          check_geometry(shape, degree);
        }
      check_serialization(shape);
    }
  check_flags();
  check_triangle();
  check_area();
  check_input();
  return 0;
}
