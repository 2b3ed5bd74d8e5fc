#include "surface_fit.h"

#include <deal.II/base/symmetric_tensor.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <mortise/base/error.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// A residual and its derivatives with respect to the unknowns.
    struct Row
    {
      double              residual;
      std::vector<double> slopes;
    };

    /// Least-squares step for @p rows; empty if they do not determine it.
    std::vector<double>
    least_squares_step(const std::vector<Row> &rows)
    {
      const unsigned int     n = rows.front().slopes.size();
      FullMatrix<double>     normal(n, n);
      dealii::Vector<double> right(n), step(n);
      for (const Row &row : rows)
        for (unsigned int i = 0; i < n; ++i)
          {
            right[i] -= row.slopes[i] * row.residual;
            for (unsigned int j = 0; j < n; ++j)
              normal(i, j) += row.slopes[i] * row.slopes[j];
          }
      // slopes are of order one: lengths are measured in radii
      constexpr double   singular = 1e-12;
      FullMatrix<double> inverse(n, n);
      inverse.copy_from(normal);
      try
        {
          inverse.gauss_jordan();
        }
      catch (const std::exception &)
        {
          return {};
        }
      if (!(inverse.linfty_norm() * normal.linfty_norm() < 1. / singular))
        return {};
      inverse.vmult(step, right);
      return std::vector<double>(step.begin(), step.end());
    }

    /// Largest entry of a step in magnitude; -1 if there is none.
    double
    size_of_step(const std::vector<double> &step)
    {
      double size = step.empty() ? -1. : 0.;
      for (const double s : step)
        size = std::max(size, std::fabs(s));
      return size;
    }

    Point<3>
    centroid(const std::vector<Point<3>> &points)
    {
      Tensor<1, 3> sum;
      for (const Point<3> &x : points)
        sum += x;
      return Point<3>(sum / double(points.size()));
    }

    double
    largest_distance(const std::vector<Point<3>> &points, const Point<3> &from)
    {
      double largest = 0.;
      for (const Point<3> &x : points)
        largest = std::max(largest, x.distance(from));
      return largest;
    }

    [[noreturn]] void
    undetermined(const std::string &where, const std::string &what)
    {
      throw InputError(where +
                       ": the vertices of this boundary do not determine a " +
                       what + "; give its centre or axis, and radius");
    }

    struct Circle
    {
      Point<3> centre;
      double   radius;
    };

    /// Linear fit of |x|^2 = 2 c x + d in the coordinates along @p directions:
    /// a sphere (three) or the circle of a cylinder (two).
    bool
    fit_linear(const std::vector<Point<3>>     &points,
               const std::vector<Tensor<1, 3>> &directions,
               Circle                          &circle)
    {
      const Point<3>   origin = centroid(points);
      const double     scale  = largest_distance(points, origin);
      std::vector<Row> rows;
      for (const Point<3> &x : points)
        {
          Row    row;
          double square = 0.;
          for (const Tensor<1, 3> &direction : directions)
            {
              const double s = (x - origin) * direction / scale;
              row.slopes.push_back(2. * s);
              square += s * s;
            }
          row.slopes.push_back(1.);
          row.residual = -square;
          rows.push_back(row);
        }
      const auto solution = least_squares_step(rows);
      if (solution.empty())
        return false;
      double square = solution.back();
      circle.centre = origin;
      for (unsigned int d = 0; d < directions.size(); ++d)
        {
          circle.centre += scale * solution[d] * directions[d];
          square += solution[d] * solution[d];
        }
      circle.radius = scale * std::sqrt(std::max(0., square));
      return circle.radius > 0.;
    }

    /// Repeat @p step (which returns its size relative to the radius, or a
    /// negative number if there is none) until it is rounding.
    bool
    iterate(const std::function<double()> &step)
    {
      constexpr unsigned int max_iterations = 100;
      double                 last           = 2.;
      for (unsigned int i = 0; i < max_iterations; ++i)
        {
          const double size = step();
          if (size < 0. || !std::isfinite(size))
            return false;
          if (size < 1e-15 || (size < 1e-10 && size > 0.5 * last))
            return true;
          last = size;
        }
      return last < 1e-8;
    }

    /// Two directions that make an orthonormal frame with @p axis.
    std::array<Tensor<1, 3>, 2>
    across(const Tensor<1, 3> &axis)
    {
      unsigned int smallest = 0;
      for (unsigned int d = 1; d < 3; ++d)
        if (std::fabs(axis[d]) < std::fabs(axis[smallest]))
          smallest = d;
      Tensor<1, 3> u =
        cross_product_3d(axis, Tensor<1, 3>(Point<3>::unit_vector(smallest)));
      u /= u.norm();
      return {{u, cross_product_3d(axis, u)}};
    }

    /// One Gauss-Newton step for axis, position and radius.
    double
    cylinder_step(const std::vector<Point<3>> &points,
                  Tensor<1, 3>                &axis,
                  Circle                      &circle)
    {
      const auto       uv = across(axis);
      std::vector<Row> rows;
      for (const Point<3> &x : points)
        {
          const Tensor<1, 3> from   = (x - circle.centre) / circle.radius;
          const double       height = from * axis;
          Tensor<1, 3>       e      = from - height * axis;
          const double       r      = e.norm();
          if (r == 0.)
            return -1.;
          e /= r;
          // d = from - height axis, of length r; turning the axis by t u
          // changes d by -height t u and along the axis
          rows.push_back({r - 1.,
                          {-(e * uv[0]),
                           -(e * uv[1]),
                           -height * (e * uv[0]),
                           -height * (e * uv[1]),
                           -1.}});
        }
      const auto   step = least_squares_step(rows);
      const double size = size_of_step(step);
      if (size < 0.)
        return size;
      circle.centre += circle.radius * (step[0] * uv[0] + step[1] * uv[1]);
      axis += step[2] * uv[0] + step[3] * uv[1];
      axis /= axis.norm();
      circle.radius *= 1. + step[4];
      return size;
    }
  } // namespace

  SurfacePointer
  fit_sphere(const std::vector<Point<3>> &points,
             const std::vector<double>   &given,
             const std::string           &where)
  {
    if (given.size() >= 3)
      {
        const Point<3> centre(given[0], given[1], given[2]);
        double         radius = given.size() > 3 ? given[3] : 0.;
        for (const Point<3> &x : points)
          if (given.size() == 3)
            radius += x.distance(centre) / points.size();
        return make_sphere(centre, radius);
      }
    Circle sphere;
    bool   good = fit_linear(points,
                             {Point<3>::unit_vector(0),
                              Point<3>::unit_vector(1),
                              Point<3>::unit_vector(2)},
                           sphere);
    good        = good && iterate([&]() {
             std::vector<Row> rows;
             for (const Point<3> &x : points)
               {
                 const Tensor<1, 3> from = (x - sphere.centre) / sphere.radius;
                 const Tensor<1, 3> e    = from / from.norm();
                 rows.push_back({from.norm() - 1., {-e[0], -e[1], -e[2], -1.}});
               }
             const auto   step = least_squares_step(rows);
             const double size = size_of_step(step);
             if (size < 0.)
               return size;
             sphere.centre += sphere.radius *
                              Tensor<1, 3>(Point<3>(step[0], step[1], step[2]));
             sphere.radius *= 1. + step[3];
             return size;
           });
    if (!good)
      undetermined(where, "sphere");
    return make_sphere(sphere.centre, sphere.radius);
  }

  SurfacePointer
  fit_cylinder(const std::vector<Point<3>>     &points,
               const std::vector<Tensor<1, 3>> &normals,
               const std::vector<double>       &given,
               const std::string               &where)
  {
    if (given.size() >= 6)
      {
        const Point<3>     on_axis(given[0], given[1], given[2]);
        const Tensor<1, 3> axis   = Point<3>(given[3], given[4], given[5]);
        double             radius = given.size() > 6 ? given[6] : 0.;
        const auto         line   = make_cylinder(on_axis, axis, 0.);
        for (const Point<3> &x : points)
          if (given.size() == 6)
            radius += line->distance(x).value / points.size();
        return make_cylinder(on_axis, axis, radius);
      }
    SymmetricTensor<2, 3> spread;
    for (const Tensor<1, 3> &normal : normals)
      if (normal.norm() > 0.)
        spread += symmetrize(outer_product(normal, normal)) / normal.norm();
    // the normals are at right angles with the axis
    Tensor<1, 3> axis = eigenvectors(spread)[2].second;
    const auto   uv   = across(axis);
    Circle       circle;
    if (!fit_linear(points, {uv[0], uv[1]}, circle) ||
        !iterate([&]() { return cylinder_step(points, axis, circle); }))
      undetermined(where, "cylinder");
    return make_cylinder(circle.centre, axis, circle.radius);
  }
} // namespace mortise
