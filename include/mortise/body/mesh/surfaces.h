// True shapes of boundaries: spheres, cylinders, planes, faces of a CAD file.
// Each is a function that vanishes on it. They know no mesh.
#pragma once

#include <deal.II/base/point.h>

#include <mortise/base/rigid_motion.h>

#include <memory>
#include <string>
#include <vector>

namespace mortise
{
  class Surface
  {
  public:
    virtual ~Surface() = default;

    /// Signed distance of a point near the surface, and the normal at the
    /// point of the surface that is nearest.
    struct Distance
    {
      double               value = 0.;
      dealii::Tensor<1, 3> normal;
    };
    virtual Distance
    distance(const dealii::Point<3> &x) const = 0;

    /// The surface after @p motion.
    virtual std::shared_ptr<const Surface>
    moved(const RigidMotion &motion) const = 0;

    /// A length that the surface has: its radius, its size.
    virtual double
    size() const = 0;

    /// For people, e.g. "sphere with centre (0, 0, 0) and radius 1".
    virtual std::string
    text() const = 0;
  };

  using SurfacePointer = std::shared_ptr<const Surface>;

  SurfacePointer
  make_sphere(const dealii::Point<3> &centre, double radius);

  /// @p axis: a direction of any length.
  SurfacePointer
  make_cylinder(const dealii::Point<3>     &on_axis,
                const dealii::Tensor<1, 3> &axis,
                double                      radius);

  /// @p normal of any length; size 1.
  SurfacePointer
  make_plane(const dealii::Point<3> &point, const dealii::Tensor<1, 3> &normal);

  /// Of several surfaces, the nearest to a point.
  SurfacePointer
  make_nearest_of(const std::vector<SurfacePointer> &surfaces);

  /// The faces of the STEP file @p file_name, in the unit of the file. Throws
  /// InputError (starting with @p where) if it cannot be read or OpenCASCADE is
  /// not there.
  std::vector<SurfacePointer>
  read_step_faces(const std::string &file_name, const std::string &where);

  /// The point of all @p surfaces (one or two) that is nearest to @p x, in the
  /// limit of small distances. Two surfaces that touch without crossing count
  /// as the first alone.
  dealii::Point<3>
  project(const std::vector<SurfacePointer> &surfaces,
          const dealii::Point<3>            &x);
} // namespace mortise
