#include <mortise/body/mesh/surfaces.h>

#include <cmath>
#include <sstream>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    std::string
    text_of(const Tensor<1, 3> &x)
    {
      std::ostringstream text;
      text << "(" << x[0] << ", " << x[1] << ", " << x[2] << ")";
      return text.str();
    }

    std::string
    text_of(const double x)
    {
      std::ostringstream text;
      text << x;
      return text.str();
    }

    class Sphere : public Surface
    {
    public:
      Sphere(const Point<3> &centre, const double radius)
        : centre(centre)
        , radius(radius)
      {}

      Distance
      distance(const Point<3> &x) const override
      {
        const Tensor<1, 3> from = x - centre;
        const double       r    = from.norm();
        return {r - radius, r > 0. ? from / r : Point<3>::unit_vector(2)};
      }

      SurfacePointer
      moved(const RigidMotion &motion) const override
      {
        return make_sphere(motion(centre), radius);
      }

      double
      size() const override
      {
        return radius;
      }

      std::string
      text() const override
      {
        return "sphere with centre " + text_of(centre) + " and radius " +
               text_of(radius);
      }

    private:
      const Point<3> centre;
      const double   radius;
    };

    class Cylinder : public Surface
    {
    public:
      Cylinder(const Point<3>     &on_axis,
               const Tensor<1, 3> &axis,
               const double        radius)
        : on_axis(on_axis)
        , axis(axis / axis.norm())
        , radius(radius)
      {}

      Distance
      distance(const Point<3> &x) const override
      {
        Tensor<1, 3> from = x - on_axis;
        from -= (from * axis) * axis;
        const double r = from.norm();
        return {r - radius, r > 0. ? from / r : axis};
      }

      SurfacePointer
      moved(const RigidMotion &motion) const override
      {
        return make_cylinder(motion(on_axis), motion.rotation * axis, radius);
      }

      double
      size() const override
      {
        return radius;
      }

      std::string
      text() const override
      {
        return "cylinder with axis " + text_of(axis) + " through " +
               text_of(on_axis) + " and radius " + text_of(radius);
      }

    private:
      const Point<3>     on_axis;
      const Tensor<1, 3> axis;
      const double       radius;
    };

    class Plane : public Surface
    {
    public:
      Plane(const Point<3> &point, const Tensor<1, 3> &normal)
        : point(point)
        , normal(normal / normal.norm())
      {}

      Distance
      distance(const Point<3> &x) const override
      {
        return {(x - point) * normal, normal};
      }

      SurfacePointer
      moved(const RigidMotion &motion) const override
      {
        return make_plane(motion(point), motion.rotation * normal);
      }

      double
      size() const override
      {
        return 1.;
      }

      std::string
      text() const override
      {
        return "plane through " + text_of(point) + " with normal " +
               text_of(normal);
      }

    private:
      const Point<3>     point;
      const Tensor<1, 3> normal;
    };

    class NearestOf : public Surface
    {
    public:
      explicit NearestOf(const std::vector<SurfacePointer> &surfaces)
        : surfaces(surfaces)
      {}

      Distance
      distance(const Point<3> &x) const override
      {
        Distance nearest = surfaces[0]->distance(x);
        for (std::size_t s = 1; s < surfaces.size(); ++s)
          {
            const Distance other = surfaces[s]->distance(x);
            if (std::fabs(other.value) < std::fabs(nearest.value))
              nearest = other;
          }
        return nearest;
      }

      SurfacePointer
      moved(const RigidMotion &motion) const override
      {
        std::vector<SurfacePointer> result;
        for (const SurfacePointer &surface : surfaces)
          result.push_back(surface->moved(motion));
        return make_nearest_of(result);
      }

      double
      size() const override
      {
        double least = surfaces[0]->size();
        for (const SurfacePointer &surface : surfaces)
          least = std::min(least, surface->size());
        return least;
      }

      std::string
      text() const override
      {
        return std::to_string(surfaces.size()) + " surfaces, the first a " +
               surfaces[0]->text();
      }

    private:
      const std::vector<SurfacePointer> surfaces;
    };
  } // namespace

  SurfacePointer
  make_sphere(const Point<3> &centre, const double radius)
  {
    return std::make_shared<Sphere>(centre, radius);
  }

  SurfacePointer
  make_cylinder(const Point<3>     &on_axis,
                const Tensor<1, 3> &axis,
                const double        radius)
  {
    return std::make_shared<Cylinder>(on_axis, axis, radius);
  }

  SurfacePointer
  make_plane(const Point<3> &point, const Tensor<1, 3> &normal)
  {
    return std::make_shared<Plane>(point, normal);
  }

  SurfacePointer
  make_nearest_of(const std::vector<SurfacePointer> &surfaces)
  {
    if (surfaces.size() == 1)
      return surfaces[0];
    return std::make_shared<NearestOf>(surfaces);
  }

  Point<3>
  project(const std::vector<SurfacePointer> &surfaces, const Point<3> &start)
  {
    constexpr unsigned int max_iterations = 30;
    constexpr double       parallel       = 0.05; // sine of the angle, squared

    Point<3> x         = start;
    double   last_step = std::numeric_limits<double>::max();
    for (unsigned int i = 0; i < max_iterations; ++i)
      {
        const Surface::Distance a    = surfaces[0]->distance(x);
        Tensor<1, 3>            step = -a.value * a.normal;
        if (surfaces.size() > 1)
          {
            // the least step that is -value along each normal
            const Surface::Distance b = surfaces[1]->distance(x);
            const double            c = a.normal * b.normal, sine = 1. - c * c;
            if (sine > parallel)
              step = -((a.value - c * b.value) / sine * a.normal +
                       (b.value - c * a.value) / sine * b.normal);
          }
        // rounding stops the steps from falling
        if (!(step.norm() < 0.5 * last_step))
          break;
        last_step = step.norm();
        x += step;
        if (last_step == 0.)
          break;
      }
    return x;
  }
} // namespace mortise
