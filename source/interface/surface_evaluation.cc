#include <deal.II/base/exceptions.h>
#include <deal.II/base/quadrature_lib.h>

#include <mortise/interface/surface_evaluation.h>

#include <array>
#include <memory>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    long double
    binomial(const unsigned int n, const unsigned int k)
    {
      long double result = 1;
      for (unsigned int i = 1; i <= k; ++i)
        result = result * (n - k + i) / i;
      return result;
    }

    // Values and derivatives of the Lagrange basis from products from the left
    // and the right: no division, exact at the nodes.
    template <unsigned int degree>
    inline void
    evaluate_basis(const LagrangeBasis &basis,
                   const LanesPart     &x,
                   LanesPart (&value)[degree + 1],
                   LanesPart (&derivative)[degree + 1])
    {
      using V = LanesPart;
      V left  = V{} + 1., left_derivative{};
      for (unsigned int i = 0; i <= degree; ++i)
        {
          value[i]        = left * basis.weight[i];
          derivative[i]   = left_derivative * basis.weight[i];
          const V factor  = x - basis.node[i];
          left_derivative = left_derivative * factor + left;
          left            = left * factor;
        }
      V right = V{} + 1., right_derivative{};
      for (unsigned int i = degree + 1; i-- > 0;)
        {
          derivative[i]  = derivative[i] * right + value[i] * right_derivative;
          value[i]       = value[i] * right;
          const V factor = x - basis.node[i];
          right_derivative = right_derivative * factor + right;
          right            = right * factor;
        }
    }

    template <unsigned int degree>
    void
    evaluate_face(const FacePolynomial &face,
                  const Lanes          &xi_1,
                  const Lanes          &xi_2,
                  Vec3<Lanes>          &x,
                  Vec3<Lanes> (&dx)[2])
    {
      using V                      = LanesPart;
      constexpr unsigned int n     = degree + 1;
      const auto            &basis = lagrange_basis(degree);
      for (unsigned int part = 0; part < n_lane_parts; ++part)
        {
          V value_1[n], derivative_1[n], value_2[n], derivative_2[n];
          evaluate_basis<degree>(basis,
                                 part_of(xi_1, part),
                                 value_1,
                                 derivative_1);
          evaluate_basis<degree>(basis,
                                 part_of(xi_2, part),
                                 value_2,
                                 derivative_2);
          for (unsigned int d = 0; d < 3; ++d)
            {
              const double *c = face.coefficients[d];
              V             sum{}, sum_1{}, sum_2{};
              for (unsigned int j = 0; j < n; ++j, c += n)
                {
                  V row = value_1[0] * c[0], row_1 = derivative_1[0] * c[0];
                  for (unsigned int i = 1; i < n; ++i)
                    {
                      row += value_1[i] * c[i];
                      row_1 += derivative_1[i] * c[i];
                    }
                  sum += value_2[j] * row;
                  sum_1 += value_2[j] * row_1;
                  sum_2 += derivative_2[j] * row;
                }
              part_of(x[d], part)     = sum;
              part_of(dx[0][d], part) = sum_1;
              part_of(dx[1][d], part) = sum_2;
            }
        }
    }

    template <unsigned int degree>
    void
    evaluate_edges_of_degree(const EdgePolynomial (&edges)[4],
                             const unsigned int (&edge)[n_lanes],
                             const Lanes &tau,
                             Vec3<Lanes> &x,
                             Vec3<Lanes> &dx)
    {
      using V                     = LanesPart;
      constexpr unsigned int n    = degree + 1;
      constexpr unsigned int size = n_lanes / n_lane_parts;
      for (unsigned int part = 0; part < n_lane_parts; ++part)
        {
          V value[n], derivative[n];
          evaluate_basis<degree>(lagrange_basis(degree),
                                 part_of(tau, part),
                                 value,
                                 derivative);
          for (unsigned int d = 0; d < 3; ++d)
            {
              V sum{}, sum_1{};
              for (unsigned int i = 0; i < n; ++i)
                {
                  V c;
                  for (unsigned int l = 0; l < size; ++l)
                    c[l] = edges[edge[part * size + l]].coefficients[d][i];
                  sum += value[i] * c;
                  sum_1 += derivative[i] * c;
                }
              part_of(x[d], part)  = sum;
              part_of(dx[d], part) = sum_1;
            }
        }
    }

    LagrangeBasis
    make_basis(const unsigned int degree)
    {
      LagrangeBasis          basis{};
      const QGaussLobatto<1> nodes(degree + 1);
      basis.degree = degree;
      for (unsigned int i = 0; i <= degree; ++i)
        basis.node[i] = nodes.point(i)[0];
      // Monomial coefficients a_j of each basis function, then the Bernstein
      // coefficients c_k = sum_j binom(k,j)/binom(g,j) a_j: sums that cancel,
      // so in extended precision.
      for (unsigned int i = 0; i <= degree; ++i)
        {
          long double  weight = 1, monomial[max_face_nodes] = {1};
          unsigned int order = 0;
          for (unsigned int j = 0; j <= degree; ++j)
            if (j != i)
              {
                const long double node = basis.node[j];
                weight /= basis.node[i] - node;
                ++order;
                for (unsigned int k = order; k > 0; --k)
                  monomial[k] = monomial[k - 1] - node * monomial[k];
                monomial[0] *= -node;
              }
          for (unsigned int k = 0; k <= degree; ++k)
            {
              long double sum = 0;
              for (unsigned int j = 0; j <= k; ++j)
                sum += binomial(k, j) / binomial(degree, j) * monomial[j];
              basis.bernstein[k][i] = sum * weight;
            }
          basis.weight[i] = weight;
        }
      return basis;
    }
  } // namespace


  const LagrangeBasis &
  lagrange_basis(const unsigned int degree)
  {
    static const std::array<LagrangeBasis, max_face_degree> bases = {
      {make_basis(1),
       make_basis(2),
       make_basis(3),
       make_basis(4),
       make_basis(5),
       make_basis(6),
       make_basis(7),
       make_basis(8)}};
    return bases[degree - 1];
  }



  GaussRule::GaussRule(const unsigned int n)
    : n(n)
  {
    const QGauss<1> quadrature(n);
    for (unsigned int q = 0; q < n; ++q)
      {
        point.push_back(quadrature.point(q)[0]);
        weight.push_back(quadrature.weight(q));
      }
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
        {
          const double along = 1. - point[j];
          square.xi_1.push_back(point[i]);
          square.xi_2.push_back(point[j]);
          square.weight.push_back(weight[i] * weight[j]);
          triangle.xi_1.push_back(point[i] * along);
          triangle.xi_2.push_back(point[j]);
          triangle.weight.push_back(weight[i] * weight[j] * along);
        }
  }



  const GaussRule &
  gauss_rule(const unsigned int n)
  {
    AssertIndexRange(n - 1, max_gauss_points);
    static std::array<std::unique_ptr<const GaussRule>, max_gauss_points> rules;
    if (!rules[n - 1])
      rules[n - 1] = std::make_unique<const GaussRule>(n);
    return *rules[n - 1];
  }



  void
  FacePolynomial::reinit(const SurfaceFace &face, const Point<3> &origin)
  {
    degree = face.degree;
    for (unsigned int i = 0; i < face.points.size(); ++i)
      for (unsigned int d = 0; d < 3; ++d)
        coefficients[d][i] = face.points[i][d] - origin[d];
  }



  void
  FacePolynomial::evaluate(const Lanes &xi_1,
                           const Lanes &xi_2,
                           Vec3<Lanes> &x,
                           Vec3<Lanes> (&dx)[2]) const
  {
    switch (degree)
      {
        case 1:
          return evaluate_face<1>(*this, xi_1, xi_2, x, dx);
        case 2:
          return evaluate_face<2>(*this, xi_1, xi_2, x, dx);
        case 3:
          return evaluate_face<3>(*this, xi_1, xi_2, x, dx);
        case 4:
          return evaluate_face<4>(*this, xi_1, xi_2, x, dx);
        case 5:
          return evaluate_face<5>(*this, xi_1, xi_2, x, dx);
        case 6:
          return evaluate_face<6>(*this, xi_1, xi_2, x, dx);
        case 7:
          return evaluate_face<7>(*this, xi_1, xi_2, x, dx);
        case 8:
          return evaluate_face<8>(*this, xi_1, xi_2, x, dx);
        default:
          Assert(false, ExcInternalError());
      }
  }



  void
  EdgePolynomial::reinit(const FacePolynomial &face,
                         const FaceShape       shape,
                         const unsigned int    edge)
  {
    degree       = face.degree;
    const int  g = degree, n = g + 1;
    const bool triangle = shape == FaceShape::triangle;
    // The nodes are symmetric about 1/2: the support points (g-j, j) lie on the
    // hypotenuse, at its own nodes.
    const int first = edge == 0 ? 0 :
                      edge == 1 ? g :
                      edge == 2 ? (triangle ? n * g : n * n - 1) :
                                  n * g;
    const int step  = edge == 0 ? 1 :
                      edge == 1 ? (triangle ? g : n) :
                      edge == 2 ? (triangle ? -n : -1) :
                                  -n;
    for (int i = 0; i < n; ++i)
      for (unsigned int d = 0; d < 3; ++d)
        coefficients[d][i] = face.coefficients[d][first + i * step];
  }



  void
  evaluate_edges(const EdgePolynomial (&edges)[4],
                 const unsigned int (&edge)[n_lanes],
                 const Lanes &tau,
                 Vec3<Lanes> &x,
                 Vec3<Lanes> &dx)
  {
    switch (edges[0].degree)
      {
        case 1:
          return evaluate_edges_of_degree<1>(edges, edge, tau, x, dx);
        case 2:
          return evaluate_edges_of_degree<2>(edges, edge, tau, x, dx);
        case 3:
          return evaluate_edges_of_degree<3>(edges, edge, tau, x, dx);
        case 4:
          return evaluate_edges_of_degree<4>(edges, edge, tau, x, dx);
        case 5:
          return evaluate_edges_of_degree<5>(edges, edge, tau, x, dx);
        case 6:
          return evaluate_edges_of_degree<6>(edges, edge, tau, x, dx);
        case 7:
          return evaluate_edges_of_degree<7>(edges, edge, tau, x, dx);
        case 8:
          return evaluate_edges_of_degree<8>(edges, edge, tau, x, dx);
        default:
          Assert(false, ExcInternalError());
      }
  }
} // namespace mortise
