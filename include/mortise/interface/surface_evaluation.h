// Evaluation of the polynomial of one curved face or of one of its edges, eight
// points at a time.
#pragma once

#include <mortise/interface/lanes.h>
#include <mortise/interface/reference_face.h>
#include <mortise/interface/surface_face.h>

namespace mortise
{
  /// Largest geometry degree and the number of 1D support points that belongs
  /// to it.
  constexpr unsigned int max_face_degree = 8;
  constexpr unsigned int max_face_nodes  = max_face_degree + 1;

  /// Lagrange polynomials of one degree on the Gauss-Lobatto nodes of [0,1].
  struct LagrangeBasis
  {
    unsigned int degree;
    double       node[max_face_nodes];
    double weight[max_face_nodes]; ///< barycentric: 1 / prod_j (x_i - x_j)

    /// Bernstein coefficients of the basis: row i, column of basis function j.
    /// The control points of a face contain it in their convex hull.
    double bernstein[max_face_nodes][max_face_nodes];
  };

  /// The basis of @p degree, 1..8.
  const LagrangeBasis &
  lagrange_basis(const unsigned int degree);

  /// A rule on the reference domain of a face, as separate arrays.
  struct ReferenceRule
  {
    std::vector<double> xi_1, xi_2, weight;
  };

  /// Gauss rule on [0,1] and rules with n points per direction on faces: the
  /// tensor product on the square, first coordinate fastest, and the same in
  /// collapsed coordinates on the triangle, (s,t) -> (s (1-t), t) with dA
  /// = (1-t) ds dt, exact for total degree 2n-2.
  struct GaussRule
  {
    explicit GaussRule(const unsigned int n);

    const ReferenceRule &
    on(const FaceShape shape) const
    {
      return shape == FaceShape::triangle ? triangle : square;
    }

    unsigned int        n;
    std::vector<double> point, weight;
    ReferenceRule       square, triangle;
  };

  /// Most points per direction that gauss_rule() offers.
  constexpr unsigned int max_gauss_points = 40;

  /// The rule of n points, 1..40.
  const GaussRule &
  gauss_rule(const unsigned int n);

  /// A face's polynomial relative to an origin, one array per coordinate.
  struct FacePolynomial
  {
    unsigned int degree = 0;
    double       coefficients[3][max_face_nodes * max_face_nodes];

    /// Points of @p face minus @p origin.
    void
    reinit(const SurfaceFace &face, const dealii::Point<3> &origin);

    /// Position and both derivatives at (xi_1, xi_2); also right outside
    /// [0,1]^2.
    void
    evaluate(const Lanes &xi_1,
             const Lanes &xi_2,
             Vec3<Lanes> &x,
             Vec3<Lanes> (&dx)[2]) const;

    /// |dx/dxi_1 x dx/dxi_2|, and the position.
    Lanes
    area_element(const Lanes &xi_1, const Lanes &xi_2, Vec3<Lanes> &x) const
    {
      Vec3<Lanes> dx[2];
      evaluate(xi_1, xi_2, x, dx);
      const Vec3<Lanes> normal = cross(dx[0], dx[1]);
      return square_root(dot(normal, normal));
    }

    Lanes
    area_element(const Lanes &xi_1, const Lanes &xi_2) const
    {
      Vec3<Lanes> x;
      return area_element(xi_1, xi_2, x);
    }
  };

  /// Polynomial of one edge of a face, see edge_coordinates().
  struct EdgePolynomial
  {
    unsigned int degree = 0;
    double       coefficients[3][max_face_nodes];

    void
    reinit(const FacePolynomial &face,
           const FaceShape       shape,
           const unsigned int    edge);
  };

  /// Position and derivative at tau, lane by lane on one of the edges (@p edge
  /// holds their numbers).
  void
  evaluate_edges(const EdgePolynomial (&edges)[4],
                 const unsigned int (&edge)[n_lanes],
                 const Lanes &tau,
                 Vec3<Lanes> &x,
                 Vec3<Lanes> &dx);
} // namespace mortise
