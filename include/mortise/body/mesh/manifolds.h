// Closed-form geometry of curved bodies: sphere, block with a curved middle
// surface. Each carries the rigid motion of its body.
#pragma once

#include <deal.II/grid/manifold.h>

#include <mortise/base/rigid_motion.h>

#include <memory>

namespace mortise
{
  /// Computes single points as several are.
  class MeanManifold : public dealii::Manifold<3>
  {
  public:
    dealii::Point<3>
    get_new_point(
      const dealii::ArrayView<const dealii::Point<3>> &points,
      const dealii::ArrayView<const double>           &weights) const override;
  };

  /// Concentric spheres about the body's origin: a point between others has the
  /// weighted mean of their radii and the normalised weighted mean of their
  /// directions. Weights must be such that the mean direction does not vanish
  /// (an octant always is).
  class SphereManifold : public MeanManifold
  {
  public:
    explicit SphereManifold(const RigidMotion &motion);

    std::unique_ptr<dealii::Manifold<3>>
    clone() const override
    {
      return std::make_unique<SphereManifold>(*this);
    }

    void
    get_new_points(
      const dealii::ArrayView<const dealii::Point<3>> &points,
      const dealii::Table<2, double>                  &weights,
      dealii::ArrayView<dealii::Point<3>> new_points) const override;

    dealii::Tensor<1, 3>
    get_tangent_vector(const dealii::Point<3> &x1,
                       const dealii::Point<3> &x2) const override;

  private:
    dealii::Point<3> centre;
  };

  /// The hexahedra of a shell octant, whose coarse cells divide each of three
  /// patches around an axis a into n x n equal angles atan(x_l / x_a), atan(x_k
  /// / x_a). Chart: the radius and the coordinates in a coarse cell, where a
  /// direction is that between great arcs along the edges, by their angles
  /// (Coons' surface, normalised). However often cells are cut they follow the
  /// lines of their coarse cell, as those beside them do that are not cut.
  /// Points are those of one coarse cell.
  class ShellOctantManifold : public MeanManifold
  {
  public:
    /// @p n: cells along an edge of a patch.
    ShellOctantManifold(unsigned int n, const RigidMotion &motion);

    std::unique_ptr<dealii::Manifold<3>>
    clone() const override
    {
      return std::make_unique<ShellOctantManifold>(*this);
    }

    void
    get_new_points(
      const dealii::ArrayView<const dealii::Point<3>> &points,
      const dealii::Table<2, double>                  &weights,
      dealii::ArrayView<dealii::Point<3>> new_points) const override;

    dealii::Tensor<1, 3>
    get_tangent_vector(const dealii::Point<3> &x1,
                       const dealii::Point<3> &x2) const override;

  private:
    const unsigned int n;
    const RigidMotion  motion;
  };

  /// A block x0..x1, y0..y1, z0..z1 whose middle plane z = z_middle is bent
  /// into z = z_middle + F(x, y): chart (x, y, zeta) with z = zeta + g(zeta)
  /// F(x, y), where the hat function g is 1 on the middle plane and falls
  /// linearly to 0 on bottom and top. Linear in zeta in each half, so inverted
  /// exactly. Needs |F| below the height of each half.
  class CurvedBlockManifold : public dealii::ChartManifold<3>
  {
  public:
    /// Formulas in MeshParameters.
    enum class Surface
    {
      bump,
      saddle,
      wave
    };

    /// The block and its middle surface.
    struct Shape
    {
      double  x0, y0, z0, x1, y1, z1;
      double  z_middle;
      double  amplitude;
      Surface surface;

      /// Height F over the middle plane and its derivatives in x and y.
      struct Height
      {
        double value, dx, dy;
      };
      Height
      height(double x, double y) const;
    };

    CurvedBlockManifold(const Shape &shape, const RigidMotion &motion);

    std::unique_ptr<dealii::Manifold<3>>
    clone() const override
    {
      return std::make_unique<CurvedBlockManifold>(shape, motion);
    }
    dealii::Point<3>
    pull_back(const dealii::Point<3> &p) const override;
    dealii::Point<3>
    push_forward(const dealii::Point<3> &chart) const override;
    dealii::DerivativeForm<1, 3, 3>
    push_forward_gradient(const dealii::Point<3> &chart) const override;

  private:
    Shape       shape;
    RigidMotion motion;
  };
} // namespace mortise
