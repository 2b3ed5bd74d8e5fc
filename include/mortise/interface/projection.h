// Projection along the slave's normal field, x_m(eta) = x_s(xi) + alpha n(xi),
// solved in both directions on the curved faces.
#pragma once

#include <mortise/interface/surface_evaluation.h>

namespace mortise
{
  /// A slave face with its normal field n: bilinear in the vertex normals. All
  /// positions are relative to origin(), the face's centre, so that a scene far
  /// from zero loses nothing.
  class SlaveMap
  {
  public:
    void
    reinit(const SurfaceFace &slave);

    const dealii::Point<3> &
    origin() const
    {
      return frame.center;
    }

    FaceShape
    shape() const
    {
      return reference_shape;
    }

    /// An affine face with one normal: chart() is the exact pull-back.
    bool
    linear() const
    {
      return is_linear;
    }

    /// Reference coordinates and height in the FaceFrame.
    void
    chart(const Vec3<Lanes> &x, Lanes (&xi)[2], Lanes &height) const;

    /// The same for one point: {xi_1, xi_2, height}.
    std::array<double, 3>
    chart(const Vec3<double> &x) const
    {
      return {{frame.center_xi + dot(x, center_dual[0]),
               frame.center_xi + dot(x, center_dual[1]),
               dot(x, height_dual)}};
    }

    /// Position, derivatives and normal field at points of the face.
    void
    evaluate(const Lanes (&xi)[2], Vec3<Lanes> &x, Vec3<Lanes> (&dx)[2]) const;

    Vec3<Lanes>
    normal(const Lanes (&xi)[2]) const;

    /// Point, normal and derivatives for a Newton step at any xi: the face
    /// continued a little beyond its reference domain by its polynomial and
    /// then by its tangents (continuously, and well defined however far away),
    /// the normal field continued in the same way, and dx[i] + alpha dn/dxi_i.
    void
    evaluate_extended(const Lanes (&xi)[2],
                      const Lanes &alpha,
                      Vec3<Lanes> &x,
                      Vec3<Lanes> (&dx)[2],
                      Vec3<Lanes> &n) const;

    /// Solve x = x_s(xi) + alpha n(xi) for xi and alpha. Points far outside of
    /// the face get their
    /// chart coordinates: only the side on which they lie matters there. With @p has_guess, xi
    /// and alpha start the iteration. Returns the lanes that did not converge
    /// as bits.
    unsigned int
    pull_back(const Vec3<Lanes> &x,
              const bool         has_guess,
              Lanes (&xi)[2],
              Lanes &alpha) const;

    /// d xi / d tau for a point that moves with velocity @p dx, by differentiating the rule.
    void
    pull_back_derivative(const Vec3<Lanes> &dx,
                         const Lanes (&xi)[2],
                         const Lanes &alpha,
                         Lanes (&dxi)[2]) const;

    /// Chart coordinates beyond these, widened by twist() times the height,
    /// belong to points that are outside of the face on that side.
    ReferenceBox near;

    /// Largest tilt of the normal field against the frame's normal, in
    /// reference coordinates per unit of height.
    double
    twist() const
    {
      return normal_twist;
    }

    /// Heights are limited to this, the distance of the farthest possible
    /// partner.
    double height_limit;

  private:
    void
    add_normal_rates(const Lanes (&xi)[2],
                     const Lanes &alpha,
                     Vec3<Lanes> (&dx)[2]) const;

    FaceShape      reference_shape;
    ReferenceBox   domain; ///< of the shape itself
    bool           is_linear;
    FaceFrame      frame;
    FacePolynomial polynomial;
    Vec3<double>   center_dual[2], height_dual;
    Vec3<double>
           vertex_normal[4]; ///< as coefficients of 1, xi_1, xi_2, xi_1 xi_2
    double normal_twist;
  };

  /// A master face relative to the origin of a slave face.
  class MasterMap
  {
  public:
    void
    reinit(const SurfaceFace &master, const dealii::Point<3> &origin);

    bool
    affine() const
    {
      return is_affine;
    }

    /// Solve x_m(eta) = x + alpha n for eta and alpha, n fixed. With @p has_guess, eta starts the
    /// iteration. @p x_m is the point, @p slope the product n . outward master normal direction
    /// (negative where the faces oppose). Returns the lanes that did not
    /// converge as bits.
    unsigned int
    project(const Vec3<Lanes> &x,
            const Vec3<Lanes> &n,
            const bool         has_guess,
            Lanes (&eta)[2],
            Lanes       &alpha,
            Vec3<Lanes> &x_m,
            Lanes       &slope) const;

    FaceShape      shape;
    FacePolynomial polynomial;
    EdgePolynomial edges[4]; ///< as many as the shape has
    double         orientation;

  private:
    /// Newton's method from eta as it stands; returns the lanes that did not
    /// converge.
    unsigned int
    iterate(const Vec3<Lanes> &x,
            const Vec3<Lanes> &n,
            Lanes (&eta)[2],
            Lanes       &alpha,
            Vec3<Lanes> &x_m,
            Lanes       &slope) const;

    /// For the lanes in @p wanted: the sample of the face nearest to the line
    /// through x along n whose normal opposes n.
    void
    nearest_samples(const Vec3<Lanes> &x,
                    const Vec3<Lanes> &n,
                    const unsigned int wanted,
                    Lanes (&eta)[2]) const;

    bool         is_affine;
    double       center_xi;
    Vec3<double> center, tangent[2];
  };

  /// Coefficients of r = s[0] a + s[1] b + s[2] c.
  inline void
  solve_3x3(const Vec3<Lanes> &a,
            const Vec3<Lanes> &b,
            const Vec3<Lanes> &c,
            const Vec3<Lanes> &r,
            Lanes (&s)[3])
  {
    const Vec3<Lanes> bc = cross(b, c);
    const Lanes       d  = 1. / dot(a, bc);
    s[0]                 = dot(r, bc) * d;
    s[1]                 = dot(r, cross(c, a)) * d;
    s[2]                 = dot(r, cross(a, b)) * d;
  }

  /// Bit l is set where lane l of @p a exceeds lane l of @p b or is not a number.
  inline unsigned int
  lanes_above(const Lanes &a, const Lanes &b)
  {
    const Lanes bit  = {1., 2., 4., 8., 16., 32., 64., 128.};
    const Lanes bits = a <= b ? broadcast(0.) : bit;
    double      sum  = 0;
    for (unsigned int l = 0; l < n_lanes; ++l)
      sum += bits[l];
    return static_cast<unsigned int>(sum);
  }
} // namespace mortise
