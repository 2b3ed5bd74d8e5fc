#include <deal.II/base/array_view.h>
#include <deal.II/base/numbers.h>
#include <deal.II/base/table.h>

#include <boost/container/small_vector.hpp>

#include <mortise/body/mesh/manifolds.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// A point seen from a centre.
    struct Polar
    {
      double       radius;
      Tensor<1, 3> direction;
    };

    Polar
    polar(const Tensor<1, 3> &x)
    {
      const double r = x.norm();
      Assert(r > 0., ExcMessage("The centre has no direction."));
      return {r, x / r};
    }

    Point<3>
    mean(const Point<3>                                   &centre,
         const boost::container::small_vector<Polar, 100> &points,
         const double                                     *weights)
    {
      double       radius = 0.;
      Tensor<1, 3> direction;
      for (unsigned int i = 0; i < points.size(); ++i)
        {
          radius += weights[i] * points[i].radius;
          direction += weights[i] * points[i].direction;
        }
      return centre + (radius / direction.norm()) * direction;
    }

    boost::container::small_vector<Polar, 100>
    polar_points(const Point<3>                  &centre,
                 const ArrayView<const Point<3>> &points)
    {
      boost::container::small_vector<Polar, 100> result;
      for (const Point<3> &p : points)
        result.push_back(polar(p - centre));
      return result;
    }

    /// The shorter arc of the unit sphere between two of its points, by its
    /// angle.
    class Arc
    {
    public:
      Arc() = default;

      Arc(const Tensor<1, 3> &a, const Tensor<1, 3> &b)
        : a(a)
        , angle(2. * std::asin(0.5 * (b - a).norm()))
        , across((b - std::cos(angle) * a) / std::sin(angle))
      {}

      Tensor<1, 3>
      at(const double t) const
      {
        return std::cos(t * angle) * a + std::sin(t * angle) * across;
      }

      Tensor<1, 3>
      slope(const double t) const
      {
        return angle * (std::cos(t * angle) * across - std::sin(t * angle) * a);
      }

    private:
      Tensor<1, 3> a;
      double       angle = 0.;
      Tensor<1, 3> across;
    };

    /// The chart of one coarse cell of a shell octant.
    class OctantChart
    {
    public:
      /// Of the cell, n on an edge of a patch, in whose middle @p points lie.
      OctantChart(const std::vector<Point<3>> &points, const unsigned int n)
      {
        Tensor<1, 3> sum;
        for (const Point<3> &p : points)
          sum += Tensor<1, 3>(p) / p.norm();
        for (unsigned int d = 1; d < 3; ++d)
          if (sum[d] > sum[axis])
            axis = d;
        std::array<unsigned int, 2> first;
        for (unsigned int i = 0; i < 2; ++i)
          first[i] = std::min<unsigned int>(n - 1,
                                            std::max(0.,
                                                     std::atan(sum[along(i)] /
                                                               sum[axis]) *
                                                       4. * n / numbers::PI));
        for (unsigned int v = 0; v < 4; ++v)
          {
            corner[v][axis] = 1.;
            for (unsigned int i = 0; i < 2; ++i)
              {
                const unsigned int k = first[i] + (i == 0 ? v % 2 : v / 2);
                corner[v][along(i)] =
                  k == n ? 1. : std::tan(0.25 * numbers::PI * k / n);
              }
            corner[v] /= corner[v].norm();
          }
        for (unsigned int i = 0; i < 2; ++i)
          for (unsigned int side = 0; side < 2; ++side)
            arc[i][side] =
              Arc(corner[side * (2 - i)], corner[side * (2 - i) + 1 + i]);
      }

      /// (radius, xi, eta).
      Point<3>
      pull_back(const Point<3> &x) const
      {
        // the components of the mean across x vanish: Newton's method
        double xi = 0.5, eta = 0.5;
        for (unsigned int iteration = 0; iteration < 20; ++iteration)
          {
            const Tensor<1, 3> b = mean(xi, eta), b_xi = slope(0, xi, eta),
                               b_eta = slope(1, xi, eta);
            const auto across        = [&](const Tensor<1, 3> &y,
                                    const unsigned int  i) {
              return y[along(i)] * x[axis] - y[axis] * x[along(i)];
            };
            const double f = across(b, 0), g = across(b, 1),
                         f_xi = across(b_xi, 0), f_eta = across(b_eta, 0),
                         g_xi = across(b_xi, 1), g_eta = across(b_eta, 1),
                         det   = f_xi * g_eta - f_eta * g_xi;
            const double d_xi  = (f * g_eta - f_eta * g) / det,
                         d_eta = (f_xi * g - f * g_xi) / det;
            xi -= d_xi;
            eta -= d_eta;
            if (std::fabs(d_xi) + std::fabs(d_eta) < 1e-14)
              break;
          }
        return Point<3>(Tensor<1, 3>(x).norm(), xi, eta);
      }

      Point<3>
      push_forward(const Point<3> &chart) const
      {
        const Tensor<1, 3> b = mean(chart[1], chart[2]);
        return Point<3>((chart[0] / b.norm()) * b);
      }

      /// Of push_forward() at @p chart in @p direction.
      Tensor<1, 3>
      derivative(const Point<3> &chart, const Tensor<1, 3> &direction) const
      {
        const Tensor<1, 3> b = mean(chart[1], chart[2]), e = b / b.norm(),
                           rate = direction[1] * slope(0, chart[1], chart[2]) +
                                  direction[2] * slope(1, chart[1], chart[2]);
        return direction[0] * e +
               (chart[0] / b.norm()) * (rate - (rate * e) * e);
      }

    private:
      unsigned int
      along(const unsigned int i) const
      {
        return (axis + 1 + i) % 3;
      }

      /// Between the arcs of the edges, as Coons does.
      Tensor<1, 3>
      mean(const double xi, const double eta) const
      {
        return (1. - eta) *
                 (arc[0][0].at(xi) - (1. - xi) * corner[0] - xi * corner[1]) +
               eta *
                 (arc[0][1].at(xi) - (1. - xi) * corner[2] - xi * corner[3]) +
               (1. - xi) * arc[1][0].at(eta) + xi * arc[1][1].at(eta);
      }

      /// d mean / d xi (i = 0) or eta (1).
      Tensor<1, 3>
      slope(const unsigned int i, const double xi, const double eta) const
      {
        const double t = i == 0 ? xi : eta, across = i == 0 ? eta : xi;
        return (1. - across) * arc[i][0].slope(t) +
               across * arc[i][1].slope(t) + arc[1 - i][1].at(across) -
               arc[1 - i][0].at(across) -
               (1. - across) * (corner[1 + i] - corner[0]) -
               across * (corner[3] - corner[2 - i]);
      }

      unsigned int                axis = 0;
      std::array<Tensor<1, 3>, 4> corner;
      Arc arc[2][2]; ///< along xi at eta = 0, 1, along eta at xi = 0, 1
    };
  } // namespace

  Point<3>
  MeanManifold::get_new_point(const ArrayView<const Point<3>> &points,
                              const ArrayView<const double>   &weights) const
  {
    AssertDimension(points.size(), weights.size());
    Table<2, double> table(1, weights.size());
    std::copy(weights.begin(), weights.end(), &table(0, 0));
    Point<3> result;
    get_new_points(points, table, ArrayView<Point<3>>(&result, 1));
    return result;
  }

  SphereManifold::SphereManifold(const RigidMotion &motion)
    : centre(motion.translation)
  {}

  void
  SphereManifold::get_new_points(const ArrayView<const Point<3>> &points,
                                 const Table<2, double>          &weights,
                                 ArrayView<Point<3>> new_points) const
  {
    AssertDimension(points.size(), weights.size(1));
    AssertDimension(new_points.size(), weights.size(0));
    // The caller may pass the same memory twice.
    const auto polars = polar_points(centre, points);
    for (unsigned int row = 0; row < weights.size(0); ++row)
      new_points[row] = mean(centre, polars, &weights(row, 0));
  }

  Tensor<1, 3>
  SphereManifold::get_tangent_vector(const Point<3> &x1,
                                     const Point<3> &x2) const
  {
    const Polar a = polar(x1 - centre), b = polar(x2 - centre);
    // Derivative at t = 0 of (r1 + t (r2 - r1)) times the normalised d1 + t (d2
    // - d1).
    return (b.radius - a.radius) * a.direction +
           a.radius * (b.direction - (a.direction * b.direction) * a.direction);
  }

  ShellOctantManifold::ShellOctantManifold(const unsigned int n,
                                           const RigidMotion &motion)
    : n(n)
    , motion(motion)
  {}

  void
  ShellOctantManifold::get_new_points(const ArrayView<const Point<3>> &points,
                                      const Table<2, double>          &weights,
                                      ArrayView<Point<3>> new_points) const
  {
    AssertDimension(points.size(), weights.size(1));
    AssertDimension(new_points.size(), weights.size(0));
    // the caller may pass the same memory twice
    std::vector<Point<3>> charts;
    for (const Point<3> &p : points)
      charts.push_back(motion.inverse(p));
    const OctantChart chart(charts, n);
    for (Point<3> &p : charts)
      p = chart.pull_back(p);
    for (unsigned int row = 0; row < weights.size(0); ++row)
      {
        Point<3> mean;
        for (unsigned int i = 0; i < charts.size(); ++i)
          mean += weights(row, i) * Tensor<1, 3>(charts[i]);
        new_points[row] = motion(chart.push_forward(mean));
      }
  }

  Tensor<1, 3>
  ShellOctantManifold::get_tangent_vector(const Point<3> &x1,
                                          const Point<3> &x2) const
  {
    const std::vector<Point<3>> ends = {motion.inverse(x1), motion.inverse(x2)};
    const OctantChart           chart(ends, n);
    const Point<3>              from = chart.pull_back(ends[0]);
    return motion.rotation *
           chart.derivative(from, chart.pull_back(ends[1]) - from);
  }

  CurvedBlockManifold::Shape::Height
  CurvedBlockManifold::Shape::height(const double x, const double y) const
  {
    constexpr double q  = 0.5 * numbers::PI;
    const double     ds = 2. / (x1 - x0), dt = 2. / (y1 - y0);
    const double     s = ds * (x - x0) - 1., t = dt * (y - y0) - 1.;
    double           f = 0., f_s = 0., f_t = 0.;
    switch (surface)
      {
        case Surface::bump:
          f   = std::cos(q * s) * std::cos(q * t);
          f_s = -q * std::sin(q * s) * std::cos(q * t);
          f_t = -q * std::cos(q * s) * std::sin(q * t);
          break;
        case Surface::saddle:
          f   = (s * s - t * t + 0.5 * s) / 1.5;
          f_s = (2. * s + 0.5) / 1.5;
          f_t = -2. * t / 1.5;
          break;
        case Surface::wave:
          f   = std::sin(q * s + 0.5) * std::cos(q * t);
          f_s = q * std::cos(q * s + 0.5) * std::cos(q * t);
          f_t = -q * std::sin(q * s + 0.5) * std::sin(q * t);
          break;
      }
    return {amplitude * f, amplitude * f_s * ds, amplitude * f_t * dt};
  }

  CurvedBlockManifold::CurvedBlockManifold(const Shape       &shape,
                                           const RigidMotion &motion)
    : shape(shape)
    , motion(motion)
  {}

  Point<3>
  CurvedBlockManifold::pull_back(const Point<3> &p) const
  {
    Point<3>     x = motion.inverse(p);
    const double F = shape.height(x[0], x[1]).value;
    if (x[2] <= shape.z_middle + F)
      x[2] =
        shape.z0 + (x[2] - shape.z0) / (1. + F / (shape.z_middle - shape.z0));
    else
      x[2] =
        shape.z1 - (shape.z1 - x[2]) / (1. - F / (shape.z1 - shape.z_middle));
    return x;
  }

  Point<3>
  CurvedBlockManifold::push_forward(const Point<3> &chart) const
  {
    const double g = chart[2] <= shape.z_middle ?
                       (chart[2] - shape.z0) / (shape.z_middle - shape.z0) :
                       (shape.z1 - chart[2]) / (shape.z1 - shape.z_middle);
    Point<3>     x = chart;
    x[2] += g * shape.height(chart[0], chart[1]).value;
    return motion(x);
  }

  DerivativeForm<1, 3, 3>
  CurvedBlockManifold::push_forward_gradient(const Point<3> &chart) const
  {
    const bool          lower = chart[2] <= shape.z_middle;
    const double        g     = lower ?
                                  (chart[2] - shape.z0) / (shape.z_middle - shape.z0) :
                                  (shape.z1 - chart[2]) / (shape.z1 - shape.z_middle);
    const double        g_z   = lower ? 1. / (shape.z_middle - shape.z0) :
                                        -1. / (shape.z1 - shape.z_middle);
    const Shape::Height F     = shape.height(chart[0], chart[1]);
    Tensor<2, 3>        jacobian;
    jacobian[0][0] = jacobian[1][1] = 1.;
    jacobian[2][0]                  = g * F.dx;
    jacobian[2][1]                  = g * F.dy;
    jacobian[2][2]                  = 1. + g_z * F.value;
    const Tensor<2, 3>      product = motion.rotation * jacobian;
    DerivativeForm<1, 3, 3> result;
    for (unsigned int i = 0; i < 3; ++i)
      result[i] = product[i];
    return result;
  }
} // namespace mortise
