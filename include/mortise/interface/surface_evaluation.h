// Evaluation of the polynomial of one curved face or of one of its edges, eight
// points at a time. It never iterates, projects or allocates.
#pragma once

#include <mortise/interface/surface_face.h>

#include <cmath>

namespace mortise
{
  /// Eight numbers that are computed together; the compiler maps them to what
  /// the processor has.
  using Lanes = double __attribute__((vector_size(64)));

  constexpr unsigned int n_lanes = 8;

  /// Largest geometry degree and the number of 1D support points that belongs
  /// to it.
  constexpr unsigned int max_face_degree = 8;
  constexpr unsigned int max_face_nodes  = max_face_degree + 1;

  /// All lanes equal to @p value.
  inline Lanes
  broadcast(const double value)
  {
    return Lanes{} + value;
  }

  inline Lanes
  absolute(const Lanes &a)
  {
    return a < 0. ? -a : a;
  }

  inline Lanes
  minimum(const Lanes &a, const Lanes &b)
  {
    return a < b ? a : b;
  }

  inline Lanes
  maximum(const Lanes &a, const Lanes &b)
  {
    return a > b ? a : b;
  }

  inline Lanes
  square_root(const Lanes &a)
  {
    Lanes result;
    for (unsigned int l = 0; l < n_lanes; ++l)
      result[l] = std::sqrt(a[l]);
    return result;
  }

  /// Largest entry.
  inline double
  largest(const Lanes &a)
  {
    double result = a[0];
    for (unsigned int l = 1; l < n_lanes; ++l)
      result = a[l] > result ? a[l] : result;
    return result;
  }

  /// Eight vectors in space, or one with T = double.
  template <typename T>
  struct Vec3
  {
    T v[3];

    T &
    operator[](const unsigned int i)
    {
      return v[i];
    }
    const T &
    operator[](const unsigned int i) const
    {
      return v[i];
    }
  };

  template <typename T>
  inline Vec3<T>
  operator+(const Vec3<T> &a, const Vec3<T> &b)
  {
    return {{a[0] + b[0], a[1] + b[1], a[2] + b[2]}};
  }

  template <typename T>
  inline Vec3<T>
  operator-(const Vec3<T> &a, const Vec3<T> &b)
  {
    return {{a[0] - b[0], a[1] - b[1], a[2] - b[2]}};
  }

  template <typename T, typename S>
  inline Vec3<T>
  operator*(const S &s, const Vec3<T> &a)
  {
    return {{s * a[0], s * a[1], s * a[2]}};
  }

  template <typename T, typename S>
  inline T
  dot(const Vec3<T> &a, const Vec3<S> &b)
  {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }

  template <typename T>
  inline Vec3<T>
  cross(const Vec3<T> &a, const Vec3<T> &b)
  {
    return {{a[1] * b[2] - a[2] * b[1],
             a[2] * b[0] - a[0] * b[2],
             a[0] * b[1] - a[1] * b[0]}};
  }

  inline Vec3<double>
  to_vec3(const dealii::Tensor<1, 3> &a)
  {
    return {{a[0], a[1], a[2]}};
  }

  inline Vec3<Lanes>
  broadcast(const Vec3<double> &a)
  {
    return {{broadcast(a[0]), broadcast(a[1]), broadcast(a[2])}};
  }

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

  /// Gauss points on [0,1], and their tensor product on the square as separate
  /// arrays.
  struct GaussRule
  {
    explicit GaussRule(const unsigned int n);

    unsigned int        n;
    std::vector<double> point, weight;
    std::vector<double> s, t, tensor_weight; ///< n*n, s fastest
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
  };

  /// Polynomial of one edge of a face: edge 0: xi_2 = 0, 1: xi_1 = 1, 2: xi_2 =
  /// 1, 3: xi_1 = 0, run through counter-clockwise in the reference square as
  /// tau goes from 0 to 1.
  struct EdgePolynomial
  {
    unsigned int degree = 0;
    double       coefficients[3][max_face_nodes];

    void
    reinit(const FacePolynomial &face, const unsigned int edge);
  };

  /// Reference coordinates in the face of the point tau of edge @p edge.
  inline std::array<double, 2>
  edge_coordinates(const unsigned int edge, const double tau)
  {
    switch (edge)
      {
        case 0:
          return {{tau, 0.}};
        case 1:
          return {{1., tau}};
        case 2:
          return {{1. - tau, 1.}};
        default:
          return {{0., 1. - tau}};
      }
  }

  /// Position and derivative at tau, lane by lane on one of four edges (@p edge
  /// holds 0..3).
  void
  evaluate_edges(const EdgePolynomial (&edges)[4],
                 const unsigned int (&edge)[n_lanes],
                 const Lanes &tau,
                 Vec3<Lanes> &x,
                 Vec3<Lanes> &dx);
} // namespace mortise
