#include <mortise/base/derivatives.h>
#include <mortise/body/elements/simplex_basis.h>

#include <algorithm>
#include <cmath>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Barycentric coordinates of @p x with derivatives.
    template <typename Number>
    std::array<Number, 4>
    barycentric(const Point<3> &x)
    {
      std::array<Number, 4> lambda;
      for (unsigned int d = 0; d < 3; ++d)
        set_coordinate(lambda[1 + d], x[d], d);
      lambda[0] = 1. - lambda[1] - lambda[2] - lambda[3];
      return lambda;
    }

    /// t^n P_n^(alpha,beta)(s/t) for n = 0..degree by the recurrence in three
    /// terms, a polynomial in s and t.
    template <typename Number>
    void
    evaluate_jacobi(const unsigned int degree,
                    const double       alpha,
                    const double       beta,
                    const Number      &s,
                    const Number      &t,
                    Number            *values)
    {
      values[0] = 1.;
      if (degree >= 1)
        values[1] = 0.5 * ((alpha + beta + 2.) * s + (alpha - beta) * t);
      for (unsigned int n = 1; n < degree; ++n)
        {
          const double c = 2. * n + alpha + beta;
          const double d = 2. * (n + 1.) * (n + alpha + beta + 1.) * c;
          values[n + 1] =
            (1. / d) * ((c * (c + 1.) * (c + 2.) * s +
                         (c + 1.) * (alpha * alpha - beta * beta) * t) *
                          values[n] -
                        2. * (n + alpha) * (n + beta) * (c + 2.) * (t * t) *
                          values[n - 1]);
        }
    }

    /// Modes 2..degree of the line from a to b, degree >= 2.
    template <typename Number>
    void
    evaluate_line(const unsigned int degree,
                  const Number      &a,
                  const Number      &b,
                  Number            *values)
    {
      evaluate_jacobi<Number>(degree - 2, 1., 1., b - a, a + b, values);
      for (unsigned int k = 2; k <= degree; ++k)
        values[k - 2] =
          (-std::sqrt(2. * k - 1.) / (k - 1.)) * ((a * b) * values[k - 2]);
    }

    /// Integral of (P_n^(alpha,beta))^2 ((1-s)/2)^alpha ((1+s)/2)^beta over
    /// [-1,1].
    double
    jacobi_norm(const unsigned int n, const double alpha, const double beta)
    {
      return 2. / (2. * n + alpha + beta + 1.) *
             std::exp(std::lgamma(n + alpha + 1.) + std::lgamma(n + beta + 1.) -
                      std::lgamma(n + 1.) - std::lgamma(n + alpha + beta + 1.));
    }

    /// Place of F_ij among the modes of a face: by degree, then by i.
    unsigned int
    face_mode(const unsigned int i, const unsigned int j)
    {
      return n_face_modes(i + j) + i - 2;
    }

    /// Place of an interior mode: by degree, then by i, then by j.
    unsigned int
    interior_mode(const unsigned int i,
                  const unsigned int j,
                  const unsigned int k)
    {
      unsigned int place = n_interior_modes(i + j + k + 1) + j;
      // with the sum i + j + k given, each i has that many modes
      for (unsigned int lower = 2; lower < i; ++lower)
        place += i + j + k - lower + 1;
      return place;
    }
  } // namespace

  SimplexLegendrePolynomials::SimplexLegendrePolynomials(
    const unsigned int degree,
    const VertexOrder &order)
    : ScalarPolynomialsBase<3>(degree,
                               (degree + 1) * (degree + 2) * (degree + 3) / 6)
    , order(order)
    , face_scale(n_face_modes(degree))
    , interior_scale(n_interior_modes(degree))
  {
    AssertThrow(degree >= 1 && degree <= max_simplex_degree,
                ExcMessage("SimplexLegendrePolynomials: the degree is " +
                           std::to_string(degree) + ", allowed is 1 to " +
                           std::to_string(max_simplex_degree)));
    // In collapsed coordinates the integrals are products of those of one
    // dimension; each coordinate carries a factor 1/2 for its scale.
    for (unsigned int i = 2; i < degree; ++i)
      for (unsigned int j = 0; i + j + 1 <= degree; ++j)
        {
          const double square = jacobi_norm(i - 2, 2., 2.) / 2. *
                                jacobi_norm(j, 2. * i + 1., 2.) / 2.;
          face_scale[face_mode(i, j)] = 1. / std::sqrt(square);
          for (unsigned int k = 0; i + j + k + 2 <= degree; ++k)
            interior_scale[interior_mode(i, j, k)] =
              1. /
              std::sqrt(square * jacobi_norm(k, 2. * (i + j) + 4., 2.) / 2.);
        }
  }

  template <typename Number>
  void
  SimplexLegendrePolynomials::evaluate_face(const Number &a,
                                            const Number &b,
                                            const Number &c,
                                            Number       *values) const
  {
    const unsigned int p = this->degree();
    Number             along[max_simplex_degree], across[max_simplex_degree];
    evaluate_jacobi<Number>(p - 3, 2., 2., b - a, a + b, along);
    for (unsigned int i = 2; i < p; ++i)
      {
        const Number bubble = (a * b) * (c * along[i - 2]);
        evaluate_jacobi<Number>(
          p - 1 - i, 2. * i + 1., 2., c - a - b, a + b + c, across);
        for (unsigned int j = 0; i + j + 1 <= p; ++j)
          {
            const unsigned int mode = face_mode(i, j);
            values[mode]            = face_scale[mode] * (bubble * across[j]);
          }
      }
  }

  template <typename Number>
  void
  SimplexLegendrePolynomials::evaluate_interior(const Number &a,
                                                const Number &b,
                                                const Number &c,
                                                const Number &d,
                                                Number       *values) const
  {
    const unsigned int p = this->degree();
    Number             along[max_simplex_degree], across[max_simplex_degree],
      up[max_simplex_degree];
    evaluate_jacobi<Number>(p - 4, 2., 2., b - a, a + b, along);
    for (unsigned int i = 2; i + 2 <= p; ++i)
      {
        const Number bubble = (a * b) * (c * d) * along[i - 2];
        evaluate_jacobi<Number>(
          p - 2 - i, 2. * i + 1., 2., c - a - b, a + b + c, across);
        for (unsigned int j = 0; i + j + 2 <= p; ++j)
          {
            const Number product = bubble * across[j];
            evaluate_jacobi<Number>(p - 2 - i - j,
                                    2. * (i + j) + 4.,
                                    2.,
                                    d - a - b - c,
                                    a + b + c + d,
                                    up);
            for (unsigned int k = 0; i + j + k + 2 <= p; ++k)
              {
                const unsigned int mode = interior_mode(i, j, k);
                values[mode] = interior_scale[mode] * (product * up[k]);
              }
          }
      }
  }

  template <typename Number>
  void
  SimplexLegendrePolynomials::evaluate_all(const std::array<Number, 4> &lambda,
                                           std::vector<Number> &values) const
  {
    const unsigned int p     = this->degree();
    const VertexOrder  ranks = vertex_ranks(order);
    values.resize(this->n());
    Number *next = values.data();
    for (unsigned int v = 0; v < 4; ++v)
      *next++ = lambda[v];
    if (p < 2)
      return;

    for (const auto &line : tetrahedron_lines)
      {
        // from the lower to the higher vertex
        const bool ascending = ranks[line[0]] < ranks[line[1]];
        evaluate_line(p,
                      lambda[line[ascending ? 0 : 1]],
                      lambda[line[ascending ? 1 : 0]],
                      next);
        next += n_line_modes(p);
      }
    if (p >= 3)
      for (const auto &face : tetrahedron_faces)
        {
          std::array<unsigned int, 3> r = {
            {ranks[face[0]], ranks[face[1]], ranks[face[2]]}};
          std::sort(r.begin(), r.end());
          evaluate_face(lambda[order[r[0]]],
                        lambda[order[r[1]]],
                        lambda[order[r[2]]],
                        next);
          next += n_face_modes(p);
        }
    if (p >= 4)
      evaluate_interior(lambda[order[0]],
                        lambda[order[1]],
                        lambda[order[2]],
                        lambda[order[3]],
                        next);
  }

  void
  SimplexLegendrePolynomials::evaluate_trace(
    const std::array<double, 3> &lambda,
    double                      *values) const
  {
    const unsigned int p = this->degree();
    for (const double l : lambda)
      *values++ = l;
    if (p >= 2)
      for (const auto &[v, w] : {std::make_pair(0, 1), {0, 2}, {1, 2}})
        {
          evaluate_line(p, lambda[v], lambda[w], values);
          values += n_line_modes(p);
        }
    if (p >= 3)
      evaluate_face(lambda[0], lambda[1], lambda[2], values);
  }

  void
  SimplexLegendrePolynomials::evaluate(
    const Point<3>            &point,
    std::vector<double>       &values,
    std::vector<Tensor<1, 3>> &gradients,
    std::vector<Tensor<2, 3>> &hessians,
    std::vector<Tensor<3, 3>> &third_derivatives,
    std::vector<Tensor<4, 3>> &fourth_derivatives) const
  {
    AssertThrow(third_derivatives.empty() && fourth_derivatives.empty(),
                ExcMessage("SimplexLegendrePolynomials: third and fourth "
                           "derivatives are not implemented"));
    if (gradients.empty() && hessians.empty())
      {
        if (!values.empty())
          evaluate_all(barycentric_coordinates(point), values);
        return;
      }
    if (hessians.empty())
      {
        std::vector<WithGradient> all;
        evaluate_all(barycentric<WithGradient>(point), all);
        for (unsigned int i = 0; i < values.size(); ++i)
          values[i] = value_of(all[i]);
        for (unsigned int i = 0; i < gradients.size(); ++i)
          gradients[i] = gradient_of(all[i]);
        return;
      }
    std::vector<WithHessian> all;
    evaluate_all(barycentric<WithHessian>(point), all);
    for (unsigned int i = 0; i < values.size(); ++i)
      values[i] = value_of(all[i]);
    for (unsigned int i = 0; i < gradients.size(); ++i)
      gradients[i] = gradient_of(all[i].val());
    for (unsigned int i = 0; i < hessians.size(); ++i)
      hessians[i] = hessian_of(all[i]);
  }

  double
  SimplexLegendrePolynomials::compute_value(const unsigned int i,
                                            const Point<3>    &point) const
  {
    std::vector<double> values;
    evaluate_all(barycentric_coordinates(point), values);
    return values[i];
  }

  Tensor<1, 3>
  SimplexLegendrePolynomials::compute_1st_derivative(
    const unsigned int i,
    const Point<3>    &point) const
  {
    std::vector<WithGradient> all;
    evaluate_all(barycentric<WithGradient>(point), all);
    return gradient_of(all[i]);
  }

  Tensor<2, 3>
  SimplexLegendrePolynomials::compute_2nd_derivative(
    const unsigned int i,
    const Point<3>    &point) const
  {
    std::vector<WithHessian> all;
    evaluate_all(barycentric<WithHessian>(point), all);
    return hessian_of(all[i]);
  }

  std::vector<double>
  values_at(const ScalarPolynomialsBase<3> &polynomials,
            const Point<3>                 &point,
            std::vector<Tensor<1, 3>>      *gradients)
  {
    std::vector<double>       values(polynomials.n());
    std::vector<Tensor<1, 3>> no_1;
    std::vector<Tensor<2, 3>> no_2;
    std::vector<Tensor<3, 3>> no_3;
    std::vector<Tensor<4, 3>> no_4;
    if (gradients != nullptr)
      gradients->resize(polynomials.n());
    polynomials.evaluate(point,
                         values,
                         gradients != nullptr ? *gradients : no_1,
                         no_2,
                         no_3,
                         no_4);
    return values;
  }
} // namespace mortise
