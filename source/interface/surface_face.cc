#include <mortise/base/error.h>
#include <mortise/interface/surface_evaluation.h>
#include <mortise/interface/surface_face.h>

#include <algorithm>
#include <limits>
#include <unordered_map>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    // What counts as rounding in a face's shape, relative to its size: 1e-12,
    // or what a scene far from the origin has lost.
    double
    flat_tolerance(const SurfaceFace &face)
    {
      double farthest = 0;
      for (const auto &point : face.points)
        farthest = std::max(farthest, point.norm());
      return std::max(1e-12,
                      16. * std::numeric_limits<double>::epsilon() * farthest /
                        face.size);
    }

    struct PointOnFace
    {
      Tensor<1, 3> x;
      Tensor<1, 3> dx[2];
    };

    PointOnFace
    evaluate(const FacePolynomial &polynomial,
             const double          xi_1,
             const double          xi_2)
    {
      Vec3<Lanes> x, dx[2];
      polynomial.evaluate(broadcast(xi_1), broadcast(xi_2), x, dx);
      PointOnFace result;
      for (unsigned int d = 0; d < 3; ++d)
        {
          result.x[d]     = x[d][0];
          result.dx[0][d] = dx[0][d][0];
          result.dx[1][d] = dx[1][d][0];
        }
      return result;
    }

    // Bernstein control points of the face, relative to the origin of its
    // polynomial.
    std::vector<Tensor<1, 3>>
    control_points(const FacePolynomial &polynomial)
    {
      const LagrangeBasis      &basis = lagrange_basis(polynomial.degree);
      const unsigned int        n     = polynomial.degree + 1;
      std::vector<Tensor<1, 3>> rows(n * n), result(n * n);
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int k = 0; k < n; ++k)
            for (unsigned int d = 0; d < 3; ++d)
              rows[j * n + i][d] +=
                basis.bernstein[i][k] * polynomial.coefficients[d][j * n + k];
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int k = 0; k < n; ++k)
            result[j * n + i] += basis.bernstein[j][k] * rows[k * n + i];
      return result;
    }

    // A parallelogram is its corners' linear interpolant with the fourth corner
    // where it belongs.
    bool
    is_parallelogram(const SurfaceFace &face)
    {
      const LagrangeBasis &basis     = lagrange_basis(face.degree);
      const double         tolerance = flat_tolerance(face) * face.size;
      const unsigned int   n         = face.degree + 1;
      const Tensor<1, 3>   a = face.points[face.degree] - face.points[0];
      const Tensor<1, 3>   b = face.points[n * face.degree] - face.points[0];
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          if ((face.points[j * n + i] - face.points[0] - basis.node[i] * a -
               basis.node[j] * b)
                .norm() > tolerance)
            return false;
      return true;
    }

    void
    check(const SurfaceFace &face)
    {
      const std::string where =
        "Surface face " + std::to_string(face.id) + ": ";
      if (face.shape != FaceShape::quadrilateral)
        throw InputError(
          where +
          "its shape is not a quadrilateral; only those are supported.");
      if (face.degree < 1 || face.degree > max_face_degree)
        throw InputError(where + "degree of the geometry is " +
                         std::to_string(face.degree) + "; allowed: 1 to " +
                         std::to_string(max_face_degree) + ".");
      if (face.points.size() != (face.degree + 1) * (face.degree + 1))
        throw InputError(
          where + std::to_string(face.points.size()) + " points; degree " +
          std::to_string(face.degree) + " needs " +
          std::to_string((face.degree + 1) * (face.degree + 1)) + ".");
      for (const auto &point : face.points)
        for (unsigned int d = 0; d < 3; ++d)
          if (!std::isfinite(point[d]))
            throw InputError(where + "a coordinate is not a finite number.");
    }

    void
    set_frame(SurfaceFace &face)
    {
      FacePolynomial polynomial;
      polynomial.reinit(face, Point<3>());
      const PointOnFace center = evaluate(polynomial, 0.5, 0.5);
      FaceFrame        &frame  = face.frame;
      frame.center             = Point<3>(center.x);
      frame.tangent            = {{center.dx[0], center.dx[1]}};
      frame.normal             = Tensor<1, 3>();
      for (const auto &normal : face.vertex_normals)
        frame.normal += normal;
      frame.normal /= frame.normal.norm();
      // dual[0] = t_2 x n / (t_1 . t_2 x n), dual[1] = n x t_1 / (...)
      const double volume =
        cross_product_3d(center.dx[0], center.dx[1]) * frame.normal;
      if (!(std::abs(volume) > 1e-10 * face.size * face.size * 1e-2))
        throw InputError(
          "Surface face " + std::to_string(face.id) +
          ": no area at its centre, or normals that lie in its plane.");
      frame.dual = {{cross_product_3d(center.dx[1], frame.normal) / volume,
                     cross_product_3d(frame.normal, center.dx[0]) / volume}};
    }
  } // namespace



  void
  SurfaceFace::finalize()
  {
    check(*this);
    const unsigned int n = degree + 1;
    size                 = std::max((points[n * n - 1] - points[0]).norm(),
                    (points[degree] - points[n * degree]).norm());
    affine               = is_parallelogram(*this);

    if (std::all_of(vertex_normals.begin(),
                    vertex_normals.end(),
                    [](const auto &normal) {
                      return normal.norm_square() == 0.;
                    }))
      {
        vertex_normals = corner_normals(*this);
        for (auto &normal : vertex_normals)
          normal /= normal.norm();
      }
    linear = affine;
    for (const auto &normal : vertex_normals)
      linear =
        linear && (normal - vertex_normals[0]).norm() <= flat_tolerance(*this);
    set_frame(*this);

    FacePolynomial polynomial;
    polynomial.reinit(*this, frame.center);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    frame.chart_lower         = {{infinity, infinity}};
    frame.chart_upper         = {{-infinity, -infinity}};
    frame.height_lower        = infinity;
    frame.height_upper        = -infinity;
    Tensor<1, 3> box_lower({infinity, infinity, infinity}),
      box_upper = -box_lower;
    for (const auto &point : control_points(polynomial))
      {
        for (unsigned int i = 0; i < 2; ++i)
          {
            const double chart   = 0.5 + frame.dual[i] * point;
            frame.chart_lower[i] = std::min(frame.chart_lower[i], chart);
            frame.chart_upper[i] = std::max(frame.chart_upper[i], chart);
          }
        frame.height_lower = std::min(frame.height_lower, frame.normal * point);
        frame.height_upper = std::max(frame.height_upper, frame.normal * point);
        for (unsigned int d = 0; d < 3; ++d)
          {
            box_lower[d] = std::min(box_lower[d], point[d]);
            box_upper[d] = std::max(box_upper[d], point[d]);
          }
      }
    lower = frame.center + box_lower;
    upper = frame.center + box_upper;
  }



  std::array<Tensor<1, 3>, 4>
  corner_normals(const SurfaceFace &face)
  {
    FacePolynomial polynomial;
    polynomial.reinit(face, face.points[0]);
    std::array<Tensor<1, 3>, 4> result;
    for (unsigned int v = 0; v < 4; ++v)
      {
        const PointOnFace point = evaluate(polynomial, v % 2, v / 2);
        result[v] =
          face.orientation * cross_product_3d(point.dx[0], point.dx[1]);
      }
    return result;
  }



  void
  average_vertex_normals(
    std::vector<SurfaceFace>                        &faces,
    const std::vector<std::array<std::uint64_t, 4>> &vertices)
  {
    AssertDimension(faces.size(), vertices.size());
    // The sum must not depend on the order of the faces beyond rounding of a
    // few additions.
    std::unordered_map<std::uint64_t, Tensor<1, 3>> sums;
    for (unsigned int f = 0; f < faces.size(); ++f)
      {
        const auto normals = corner_normals(faces[f]);
        for (unsigned int v = 0; v < 4; ++v)
          sums[vertices[f][v]] += normals[v];
      }
    for (unsigned int f = 0; f < faces.size(); ++f)
      for (unsigned int v = 0; v < 4; ++v)
        {
          const Tensor<1, 3> &sum    = sums[vertices[f][v]];
          faces[f].vertex_normals[v] = sum / sum.norm();
        }
  }



  double
  face_area(const SurfaceFace &face, const unsigned int n)
  {
    FacePolynomial polynomial;
    polynomial.reinit(face, face.frame.center);
    // A face that bends far away from its plane needs more points.
    const double rise =
      (face.frame.height_upper - face.frame.height_lower) / face.size;
    const unsigned int enough = face.affine ? 1 :
                                              face.degree + (rise < 0.05 ? 6 :
                                                             rise < 0.15 ? 9 :
                                                                           16);
    const GaussRule   &rule   = gauss_rule(n > 0 ? n : enough);
    double             area   = 0;
    for (unsigned int q = 0; q < rule.s.size(); q += n_lanes)
      {
        Lanes              xi[2] = {broadcast(0.5), broadcast(0.5)}, weight{};
        const unsigned int n_active =
          std::min<unsigned int>(n_lanes, rule.s.size() - q);
        for (unsigned int l = 0; l < n_active; ++l)
          {
            xi[0][l]  = rule.s[q + l];
            xi[1][l]  = rule.t[q + l];
            weight[l] = rule.tensor_weight[q + l];
          }
        Vec3<Lanes> x, dx[2];
        polynomial.evaluate(xi[0], xi[1], x, dx);
        const Vec3<Lanes> normal = cross(dx[0], dx[1]);
        const Lanes       sum    = weight * square_root(dot(normal, normal));
        for (unsigned int l = 0; l < n_lanes; ++l)
          area += sum[l];
      }
    return area;
  }



  Point<3>
  face_point(const SurfaceFace &face, const Point<2> &xi)
  {
    FacePolynomial polynomial;
    polynomial.reinit(face, face.frame.center);
    return face.frame.center + evaluate(polynomial, xi[0], xi[1]).x;
  }



  Tensor<1, 3>
  face_normal(const SurfaceFace &face, const Point<2> &xi)
  {
    FacePolynomial polynomial;
    polynomial.reinit(face, face.frame.center);
    const PointOnFace  point = evaluate(polynomial, xi[0], xi[1]);
    const Tensor<1, 3> normal =
      face.orientation * cross_product_3d(point.dx[0], point.dx[1]);
    return normal / normal.norm();
  }



  Tensor<1, 3>
  averaged_normal(const SurfaceFace &face, const Point<2> &xi)
  {
    const auto &n = face.vertex_normals;
    return (1 - xi[1]) * ((1 - xi[0]) * n[0] + xi[0] * n[1]) +
           xi[1] * ((1 - xi[0]) * n[2] + xi[0] * n[3]);
  }
} // namespace mortise
