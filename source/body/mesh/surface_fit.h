// Spheres and cylinders through points, by least squares. It knows no mesh.
#pragma once

#include <mortise/body/mesh/surfaces.h>

#include <string>
#include <vector>

namespace mortise
{
  /// @p given: nothing, the centre, or the centre and the radius. Throws
  /// InputError (starting with @p where) if the points do not determine the
  /// rest.
  SurfacePointer
  fit_sphere(const std::vector<dealii::Point<3>> &points,
             const std::vector<double>           &given,
             const std::string                   &where);

  /// @p given: nothing, a point and the direction of the axis, or these and the
  /// radius. @p normals: of faces between the points, with which the search of
  /// the axis begins.
  SurfacePointer
  fit_cylinder(const std::vector<dealii::Point<3>>     &points,
               const std::vector<dealii::Tensor<1, 3>> &normals,
               const std::vector<double>               &given,
               const std::string                       &where);
} // namespace mortise
