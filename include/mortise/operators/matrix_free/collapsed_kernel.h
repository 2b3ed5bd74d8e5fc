// Gradients on tetrahedra at Gauss points in collapsed coordinates by sum
// factorisation, several cells at once. Only sources of kernels include it.
#pragma once

#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>

#include <mortise/base/lagrange.h>
#include <mortise/base/tensor_product.h>
#include <mortise/body/elements/simplex_nodes.h>
#include <mortise/body/elements/simplex_quadrature.h>
#include <mortise/operators/matrix_free/dense_kernel.h>

#include <cmath>

namespace mortise
{
  /// Between values at the nodes of a tetrahedron and derivatives with respect
  /// to the collapsed coordinates y at the points of collapsed_quadrature(2
  /// degree), with barycentric coordinates x_d = y_d prod_(e > d) (1 - y_e) of
  /// the second to last vertex. Between them stand coefficients in Dubiner's
  /// (1991) orthonormal basis, up to factors with Jacobi polynomials on [0, 1]
  ///
  ///   P_i(y_0) (1 - y_1)^i P_j^(2i+1,0)(y_1) (1 - y_2)^(i+j)
  ///   P_k^(2i+2j+2,0)(y_2),  i + j + k <= degree.
  template <typename Number, int degree>
  class CollapsedKernel
  {
  public:
    using V                = typename Batch<Number>::Vector;
    static constexpr int n = degree + 1;
    static constexpr int N = n * (degree + 2) * (degree + 3) / 6;
    /// Points in the first two directions and in the last.
    static constexpr int m = n, l = n + 1, Q = m * m * l;

    CollapsedKernel()
    {
      const dealii::QGauss<1> first(m), last(l);
      const auto              derivatives = lagrange_derivatives(first, first),
                 in_last                  = lagrange_derivatives(last, last);
      derivative                          = Derivative(derivatives);
      transposed_derivative               = Derivative(transposed(derivatives));
      last_derivative                     = LastDerivative(in_last);
      last_transposed                     = LastDerivative(transposed(in_last));
      for (int i = 0; i < n; ++i)
        {
          for (int q = 0; q < m; ++q)
            {
              const double y = first.point(q)[0];
              A[i][q]        = std::sqrt(2. * i + 1.) * jacobi(i, 0, y);
              for (int j = 0; i + j < n; ++j)
                B[i][j][q] = std::sqrt(2. * (i + j) + 2.) *
                             std::pow(1. - y, i) * jacobi(j, 2 * i + 1, y);
            }
          for (int q = 0; q < l; ++q)
            for (int k = 0; i + k < n; ++k) // i stands for i + j
              {
                const double y = last.point(q)[0];
                C[i][k][q]     = std::sqrt(2. * (i + k) + 3.) *
                             std::pow(1. - y, i) * jacobi(k, 2 * i + 2, y);
              }
        }

      const dealii::Quadrature<3> rule = collapsed_quadrature<3>(2 * degree);
      const auto values = simplex_nodal_values(degree, rule.get_points());
      dealii::FullMatrix<double> projection(N, N);
      int                        row = 0;
      for (int i = 0; i < n; ++i)
        for (int j = 0; i + j < n; ++j)
          for (int k = 0; i + j + k < n; ++k, ++row)
            for (int q = 0; q < Q; ++q)
              {
                const double b = rule.weight(q) * A[i][q % m] *
                                 B[i][j][q / m % m] * C[i + j][k][q / (m * m)];
                for (int node = 0; node < N; ++node)
                  projection(row, node) += b * values(q, node);
              }
      to_coefficients   = DenseMatrix<Number>(projection);
      from_coefficients = DenseMatrix<Number>(transposed(projection));
      scratch.resize((3 * N + Q) * Batch<Number>::size);
    }

    /// @p u: values at nodes by component; @p g: derivatives as [component][d][point].
    void
    evaluate(const V *u, V *g)
    {
      V *coefficients = reinterpret_cast<V *>(scratch.data()),
        *v            = coefficients + 3 * N;
      to_coefficients.apply(u, coefficients);
      for (int c = 0; c < 3; ++c, coefficients += N, g += 3 * Q)
        {
          to_points(coefficients, v);
          apply_along<0, false, m, m, l>(derivative, v, g);
          apply_along<1, false, m, m, l>(derivative, v, g + Q);
          apply_along<2, false, m, m, l>(last_derivative, v, g + 2 * Q);
        }
    }

    /// The transpose.
    void
    integrate(const V *g, V *u)
    {
      V *coefficients = reinterpret_cast<V *>(scratch.data()),
        *v            = coefficients + 3 * N;
      for (int c = 0; c < 3; ++c, g += 3 * Q)
        {
          apply_along<0, false, m, m, l>(transposed_derivative, g, v);
          apply_along<1, true, m, m, l>(transposed_derivative, g + Q, v);
          apply_along<2, true, m, m, l>(last_transposed, g + 2 * Q, v);
          from_points(v, coefficients + c * N);
        }
      from_coefficients.apply(coefficients, u);
    }

  private:
    using Derivative     = LineMatrix<Number, m, m, true>;
    using LastDerivative = LineMatrix<Number, l, l, true>;

    static double
    jacobi(const int k, const int alpha, const double y)
    {
      return dealii::Polynomials::jacobi_polynomial_value<double>(k,
                                                                  alpha,
                                                                  0,
                                                                  y);
    }

    /// Coefficients come with k fastest, then j, then i.
    void
    to_points(const V *c, V *u) const
    {
      V by_i[n][l][m] = {};
      for (int i = 0; i < n; ++i)
        for (int j = 0; i + j < n; c += n - i - j, ++j)
          {
            V line[l] = {};
            for (int k = 0; i + j + k < n; ++k)
              for (int q = 0; q < l; ++q)
                line[q] += C[i + j][k][q] * c[k];
            for (int q = 0; q < l; ++q)
              for (int r = 0; r < m; ++r)
                by_i[i][q][r] += B[i][j][r] * line[q];
          }
      for (int q = 0; q < l; ++q)
        for (int r = 0; r < m; ++r, u += m)
          {
            V line[m] = {};
            for (int i = 0; i < n; ++i)
              for (int s = 0; s < m; ++s)
                line[s] += A[i][s] * by_i[i][q][r];
            for (int s = 0; s < m; ++s)
              u[s] = line[s];
          }
    }

    void
    from_points(const V *u, V *c) const
    {
      V by_i[n][l][m];
      for (int q = 0; q < l; ++q)
        for (int r = 0; r < m; ++r, u += m)
          for (int i = 0; i < n; ++i)
            {
              V sum = {};
              for (int s = 0; s < m; ++s)
                sum += A[i][s] * u[s];
              by_i[i][q][r] = sum;
            }
      for (int i = 0; i < n; ++i)
        for (int j = 0; i + j < n; c += n - i - j, ++j)
          {
            V line[l];
            for (int q = 0; q < l; ++q)
              {
                V sum = {};
                for (int r = 0; r < m; ++r)
                  sum += B[i][j][r] * by_i[i][q][r];
                line[q] = sum;
              }
            for (int k = 0; i + j + k < n; ++k)
              {
                V sum = {};
                for (int q = 0; q < l; ++q)
                  sum += C[i + j][k][q] * line[q];
                c[k] = sum;
              }
          }
    }

    DenseMatrix<Number>           to_coefficients, from_coefficients;
    Number                        A[n][m], B[n][n][m], C[n][n][l];
    Derivative                    derivative, transposed_derivative;
    LastDerivative                last_derivative, last_transposed;
    dealii::AlignedVector<Number> scratch;
  };
} // namespace mortise
