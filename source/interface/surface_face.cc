#include <mortise/base/error.h>
#include <mortise/interface/surface_evaluation.h>
#include <mortise/interface/surface_face.h>

#include <algorithm>
#include <limits>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    // Rounding of a face's shape relative to its size: 1e-12, or that of
    // coordinates far from the origin.
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

    // The polynomial of a triangle in the collapsed coordinates of GaussRule:
    // the image of the square is the triangle, and total degree g makes it one
    // of degree g per direction.
    FacePolynomial
    collapsed(const FacePolynomial &polynomial)
    {
      const LagrangeBasis &basis  = lagrange_basis(polynomial.degree);
      const unsigned int   n      = polynomial.degree + 1;
      FacePolynomial       result = polynomial;
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          {
            const double       t = basis.node[j];
            const Tensor<1, 3> x =
              evaluate(polynomial, basis.node[i] * (1. - t), t).x;
            for (unsigned int d = 0; d < 3; ++d)
              result.coefficients[d][j * n + i] = x[d];
          }
      return result;
    }

    // A triangle's points beyond the hypotenuse, by Newton's form on those in
    // it. That amplifies rounding by up to 1e6 (g = 8): in extended precision
    // what is left does not show inside the triangle.
    void
    continue_triangle(SurfaceFace &face)
    {
      using Number           = long double;
      const LagrangeBasis &v = lagrange_basis(face.degree);
      const unsigned int   g = face.degree, n = g + 1;
      for (unsigned int d = 0; d < 3; ++d)
        {
          Number       c[max_face_nodes][max_face_nodes];
          const Number origin = face.points[0][d];
          for (unsigned int j = 0; j <= g; ++j)
            for (unsigned int i = 0; i <= g - j; ++i)
              c[j][i] = face.points[j * n + i][d] - origin;
          for (unsigned int j = 0; j <= g; ++j)
            for (unsigned int k = 1; k <= g - j; ++k)
              for (unsigned int i = g - j; i >= k; --i)
                c[j][i] =
                  (c[j][i] - c[j][i - 1]) / (Number(v.node[i]) - v.node[i - k]);
          for (unsigned int i = 0; i <= g; ++i)
            for (unsigned int k = 1; k <= g - i; ++k)
              for (unsigned int j = g - i; j >= k; --j)
                c[j][i] =
                  (c[j][i] - c[j - 1][i]) / (Number(v.node[j]) - v.node[j - k]);
          for (unsigned int j = 1; j <= g; ++j)
            for (unsigned int i = n - j; i <= g; ++i)
              {
                Number sum = 0;
                for (unsigned int b = n; b-- > 0;)
                  {
                    Number row = 0;
                    for (unsigned int a = n - b; a-- > 0;)
                      row = row * (Number(v.node[i]) - v.node[a]) + c[b][a];
                    sum = sum * (Number(v.node[j]) - v.node[b]) + row;
                  }
                face.points[j * n + i][d] = origin + sum;
              }
        }
    }

    // Its affine interpolant at three vertices is the face.
    bool
    is_affine(const SurfaceFace &face)
    {
      const LagrangeBasis &basis     = lagrange_basis(face.degree);
      const double         tolerance = flat_tolerance(face) * face.size;
      const unsigned int   n         = face.degree + 1;
      const Tensor<1, 3>   a = face.points[face.degree] - face.points[0];
      const Tensor<1, 3>   b = face.points[n * face.degree] - face.points[0];
      const bool           triangle = face.shape == FaceShape::triangle;
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < (triangle ? n - j : n); ++i)
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
      FaceFrame &frame = face.frame;
      frame.center_xi  = center_coordinate(face.shape);
      const PointOnFace center =
        evaluate(polynomial, frame.center_xi, frame.center_xi);
      frame.center  = Point<3>(center.x);
      frame.tangent = {{center.dx[0], center.dx[1]}};
      frame.normal  = Tensor<1, 3>();
      for (unsigned int v = 0; v < n_vertices(face.shape); ++v)
        frame.normal += face.vertex_normals[v];
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

    // Everything that contains the face: its control points do.
    void
    set_bounds(SurfaceFace &face)
    {
      constexpr double infinity = std::numeric_limits<double>::infinity();
      const bool       triangle = face.shape == FaceShape::triangle;
      FaceFrame       &frame    = face.frame;
      FacePolynomial   polynomial;
      polynomial.reinit(face, frame.center);
      if (triangle)
        polynomial = collapsed(polynomial);
      frame.chart.lower  = {{infinity, infinity}};
      frame.chart.upper  = {{-infinity, -infinity, -infinity}};
      frame.height_lower = infinity;
      frame.height_upper = -infinity;
      Tensor<1, 3> box_lower({infinity, infinity, infinity}),
        box_upper = -box_lower;
      for (const auto &point : control_points(polynomial))
        {
          const double chart[2] = {frame.center_xi + frame.dual[0] * point,
                                   frame.center_xi + frame.dual[1] * point};
          for (unsigned int i = 0; i < 2; ++i)
            {
              frame.chart.lower[i] = std::min(frame.chart.lower[i], chart[i]);
              frame.chart.upper[i] = std::max(frame.chart.upper[i], chart[i]);
            }
          frame.chart.upper[2] =
            std::max(frame.chart.upper[2],
                     triangle ? chart[0] + chart[1] : infinity);
          const double height = frame.normal * point;
          frame.height_lower  = std::min(frame.height_lower, height);
          frame.height_upper  = std::max(frame.height_upper, height);
          for (unsigned int d = 0; d < 3; ++d)
            {
              box_lower[d] = std::min(box_lower[d], point[d]);
              box_upper[d] = std::max(box_upper[d], point[d]);
            }
        }
      face.lower = frame.center + box_lower;
      face.upper = frame.center + box_upper;
    }
  } // namespace



  void
  SurfaceFace::finalize()
  {
    check(*this);
    if (shape == FaceShape::triangle)
      continue_triangle(*this);
    const unsigned int n = degree + 1;
    const Point<3> &a = points[0], &b = points[degree], &c = points[n * degree];
    size   = shape == FaceShape::triangle ?
               std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()}) :
               std::max((points[n * n - 1] - a).norm(), (b - c).norm());
    affine = is_affine(*this);

    const auto first = vertex_normals.begin(), last = first + n_vertices(shape);
    if (std::all_of(first, last, [](const auto &normal) {
          return normal.norm_square() == 0.;
        }))
      {
        const auto normals = corner_normals(*this);
        for (unsigned int v = 0; v < n_vertices(shape); ++v)
          vertex_normals[v] = normals[v] / normals[v].norm();
      }
    if (shape == FaceShape::triangle)
      vertex_normals[3] =
        vertex_normals[1] + vertex_normals[2] - vertex_normals[0];
    linear = affine && std::all_of(first, last, [&](const auto &normal) {
               return (normal - *first).norm() <= flat_tolerance(*this);
             });
    set_frame(*this);
    set_bounds(*this);
  }



  double
  face_area(const SurfaceFace &face, const unsigned int n)
  {
    FacePolynomial polynomial;
    polynomial.reinit(face, face.frame.center);
    // A face that bends far away from its plane needs more points.
    const double rise =
      (face.frame.height_upper - face.frame.height_lower) / face.size;
    const unsigned int   enough = face.affine ? 1 :
                                                face.degree + (rise < 0.05 ? 6 :
                                                               rise < 0.15 ? 9 :
                                                                             16);
    const ReferenceRule &rule   = gauss_rule(n > 0 ? n : enough).on(face.shape);
    double               area   = 0;
    for (unsigned int q = 0; q < rule.weight.size(); q += n_lanes)
      {
        Lanes xi[2] = {broadcast(face.frame.center_xi),
                       broadcast(face.frame.center_xi)},
              weight{};
        const unsigned int n_active =
          std::min<unsigned int>(n_lanes, rule.weight.size() - q);
        for (unsigned int l = 0; l < n_active; ++l)
          {
            xi[0][l]  = rule.xi_1[q + l];
            xi[1][l]  = rule.xi_2[q + l];
            weight[l] = rule.weight[q + l];
          }
        const Lanes sum = weight * polynomial.area_element(xi[0], xi[1]);
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

  double
  sagitta(const SurfaceFace &face)
  {
    const auto own   = corner_normals(face);
    double     angle = 0.;
    for (unsigned int v = 0; v < n_vertices(face.shape); ++v)
      angle =
        std::max(angle,
                 (own[v] / own[v].norm() - face.vertex_normals[v]).norm());
    return face.size * angle / 4.;
  }
} // namespace mortise
