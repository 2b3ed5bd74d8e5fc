// A rotation about the origin followed by a translation: how a body or a scene
// is placed.
#pragma once

#include <deal.II/base/numbers.h>
#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <deal.II/physics/transformations.h>

#include <array>
#include <cmath>

namespace mortise
{
  /// The matrix of the rotation about the axis @p vector by its length, radians.
  inline dealii::Tensor<2, 3>
  rotation_by(const dealii::Tensor<1, 3> &vector)
  {
    const double angle = vector.norm();
    return angle == 0. ?
             dealii::Tensor<2, 3>(dealii::unit_symmetric_tensor<3>()) :
             dealii::Physics::Transformations::Rotations::rotation_matrix_3d(
               dealii::Point<3>(vector / angle), angle);
  }

  struct RigidMotion
  {
    /// The identity.
    RigidMotion()
    {
      for (unsigned int d = 0; d < 3; ++d)
        rotation[d][d] = 1.;
    }

    /// Rotate by @p degrees about the fixed axis x, then y, then z (rotation = Rz Ry Rx), then
    /// translate by @p shift. Multiples of 90 degrees give matrices that are exact.
    RigidMotion(const std::array<double, 3> &degrees,
                const std::array<double, 3> &shift)
      : RigidMotion()
    {
      for (unsigned int axis = 0; axis < 3; ++axis)
        {
          const unsigned int i = (axis + 1) % 3, j = (axis + 2) % 3;
          const double       c = cosine(degrees[axis]),
                       s       = cosine(degrees[axis] - 90.);
          dealii::Tensor<2, 3> turn;
          turn[axis][axis] = 1.;
          turn[i][i] = turn[j][j] = c;
          turn[i][j]              = -s;
          turn[j][i]              = s;
          rotation                = turn * rotation;
          translation[axis]       = shift[axis];
        }
    }

    /// Position after the motion of the point that was at @p p.
    dealii::Point<3>
    operator()(const dealii::Point<3> &p) const
    {
      return dealii::Point<3>(rotation * p + translation);
    }

    /// Position before the motion of the point that is now at @p p.
    dealii::Point<3>
    inverse(const dealii::Point<3> &p) const
    {
      return dealii::Point<3>(transpose(rotation) * (p - translation));
    }

    dealii::Tensor<2, 3> rotation;    ///< orthogonal, determinant 1
    dealii::Tensor<1, 3> translation; ///< in the unit of lengths of the scene

  private:
    /// Cosine of an angle in degrees, exact at multiples of 90.
    static double
    cosine(const double degrees)
    {
      const double turn = std::remainder(degrees, 360.);
      if (std::fabs(turn) == 90.)
        return 0.;
      if (std::fabs(turn) == 180.)
        return -1.;
      return std::cos(turn * dealii::numbers::PI / 180.);
    }
  };
} // namespace mortise
