#include <deal.II/base/array_view.h>
#include <deal.II/base/numbers.h>
#include <deal.II/base/table.h>

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
    /// Around one axis of the octant: (radius, two angles), in the frame of the
    /// body.
    class OctantChart
    {
    public:
      /// Around the axis that is nearest to all of @p points.
      explicit OctantChart(const std::vector<Point<3>> &points)
      {
        Tensor<1, 3> sum;
        for (const Point<3> &p : points)
          sum += Tensor<1, 3>(p) / p.norm();
        for (unsigned int d = 1; d < 3; ++d)
          if (sum[d] > sum[axis])
            axis = d;
      }

      Point<3>
      pull_back(const Point<3> &x) const
      {
        const double along = x[axis];
        Assert(along > 0., ExcMessage("The point is not in the chart."));
        return Point<3>(Tensor<1, 3>(x).norm(),
                        std::atan(x[(axis + 1) % 3] / along),
                        std::atan(x[(axis + 2) % 3] / along));
      }

      Point<3>
      push_forward(const Point<3> &chart) const
      {
        Tensor<1, 3> direction;
        direction[axis]           = 1.;
        direction[(axis + 1) % 3] = std::tan(chart[1]);
        direction[(axis + 2) % 3] = std::tan(chart[2]);
        return Point<3>((chart[0] / direction.norm()) * direction);
      }

      /// The derivative of push_forward() at @p chart in @p direction.
      Tensor<1, 3>
      derivative(const Point<3>     &chart,
                 const Tensor<1, 3> &direction) const
      {
        Tensor<1, 3> to, slope; // before it is brought to the sphere
        to[axis] = 1.;
        for (unsigned int i = 1; i < 3; ++i)
          {
            const double t         = std::tan(chart[i]);
            to[(axis + i) % 3]     = t;
            slope[(axis + i) % 3]  = (1. + t * t) * direction[i];
          }
        const double       norm = to.norm();
        const Tensor<1, 3> e    = to / norm;
        return direction[0] * e +
               (chart[0] / norm) * (slope - (slope * e) * e);
      }

    private:
      unsigned int axis = 0;
    };

    /// @p points in the frame of the body.
    std::vector<Point<3>>
    in_body(const RigidMotion &motion, const ArrayView<const Point<3>> &points)
    {
      std::vector<Point<3>> result;
      for (const Point<3> &p : points)
        result.push_back(motion.inverse(p));
      return result;
    }

    /// d(x)/d(chart) of a chart in body coordinates, turned with the body.
    DerivativeForm<1, 3, 3>
    turned(const RigidMotion &motion, const Tensor<2, 3> &jacobian)
    {
      const Tensor<2, 3>      product = motion.rotation * jacobian;
      DerivativeForm<1, 3, 3> result;
      for (unsigned int i = 0; i < 3; ++i)
        result[i] = product[i];
      return result;
    }
  } // namespace

  SphereManifold::SphereManifold(const RigidMotion &motion)
    : motion(motion)
  {}

  std::unique_ptr<Manifold<3>>
  SphereManifold::clone() const
  {
    return std::make_unique<SphereManifold>(*this);
  }

  Point<3>
  SphereManifold::get_new_point(const ArrayView<const Point<3>> &points,
                                const ArrayView<const double>   &weights) const
  {
    AssertDimension(points.size(), weights.size());
    Table<2, double> table(1, weights.size());
    std::copy(weights.begin(), weights.end(), &table(0, 0));
    Point<3> result;
    get_new_points(points, table, ArrayView<Point<3>>(&result, 1));
    return result;
  }

  void
  SphereManifold::get_new_points(const ArrayView<const Point<3>> &points,
                                 const Table<2, double>          &weights,
                                 ArrayView<Point<3>> new_points) const
  {
    AssertDimension(points.size(), weights.size(1));
    AssertDimension(new_points.size(), weights.size(0));
    // the caller may pass the same memory twice
    std::vector<Point<3>> charts = in_body(motion, points);
    const OctantChart     chart(charts);
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
  SphereManifold::get_tangent_vector(const Point<3> &x1,
                                     const Point<3> &x2) const
  {
    const std::array<Point<3>, 2> ends{{motion.inverse(x1), motion.inverse(x2)}};
    const OctantChart chart(std::vector<Point<3>>(ends.begin(), ends.end()));
    const Point<3>    from = chart.pull_back(ends[0]);
    return motion.rotation *
           chart.derivative(from, chart.pull_back(ends[1]) - from);
  }

  CylinderManifold::CylinderManifold(const RigidMotion &motion)
    : motion(motion)
  {}

  std::unique_ptr<Manifold<3>>
  CylinderManifold::clone() const
  {
    return std::make_unique<CylinderManifold>(motion);
  }

  Point<3>
  CylinderManifold::pull_back(const Point<3> &p) const
  {
    const Point<3> x = motion.inverse(p);
    return Point<3>(std::hypot(x[0], x[1]), std::atan2(x[1], x[0]), x[2]);
  }

  Point<3>
  CylinderManifold::push_forward(const Point<3> &chart) const
  {
    return motion(Point<3>(chart[0] * std::cos(chart[1]),
                           chart[0] * std::sin(chart[1]),
                           chart[2]));
  }

  DerivativeForm<1, 3, 3>
  CylinderManifold::push_forward_gradient(const Point<3> &chart) const
  {
    const double c = std::cos(chart[1]), s = std::sin(chart[1]);
    Tensor<2, 3> jacobian;
    jacobian[0][0] = c;
    jacobian[1][0] = s;
    jacobian[0][1] = -chart[0] * s;
    jacobian[1][1] = chart[0] * c;
    jacobian[2][2] = 1.;
    return turned(motion, jacobian);
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

  std::unique_ptr<Manifold<3>>
  CurvedBlockManifold::clone() const
  {
    return std::make_unique<CurvedBlockManifold>(shape, motion);
  }

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
    return turned(motion, jacobian);
  }
} // namespace mortise
