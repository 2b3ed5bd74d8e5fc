// The hierarchical polynomials of a tetrahedron, as a space of deal.II: two
// families of one dimension each, orthogonal products on faces and inside.
#pragma once

#include <deal.II/base/scalar_polynomials_base.h>

#include <mortise/body/mesh/vertex_order.h>

#include <memory>
#include <string>
#include <vector>

namespace mortise
{
  /// Highest degree of the functions on tetrahedra.
  constexpr unsigned int max_simplex_degree = 8;

  /// Number of modes of degrees up to @p degree that belong to one line, one
  /// face, the inside of a tetrahedron. The modes of degree p are the first
  /// ones of degree p + 1.
  constexpr unsigned int
  n_line_modes(const unsigned int degree)
  {
    return degree - 1;
  }
  constexpr unsigned int
  n_face_modes(const unsigned int degree)
  {
    return (degree - 1) * (degree - 2) / 2;
  }
  constexpr unsigned int
  n_interior_modes(const unsigned int degree)
  {
    return degree < 4 ? 0 : (degree - 1) * (degree - 2) * (degree - 3) / 6;
  }

  /// All polynomials of degree @p degree on the tetrahedron, by deal.II's
  /// vertices, lines, faces and the inside. With the barycentric coordinates
  /// a, b, c, d of the vertices of an entity in the given order of vertices,
  /// and Jacobi polynomials P_n^(alpha,beta)(s; t) = t^n P_n(s/t),
  ///
  /// - vertex:  a;
  /// - line:    N_k = -sqrt(2k-1)/(k-1) a b P_(k-2)^(1,1)(b-a; a+b), the
  ///            function of evaluate_lobatto() on the line, k = 2..degree;
  /// - face:    F_ij = a b P_(i-2)^(2,2)(b-a; a+b)
  ///                   c P_j^(2i+1,2)(c-a-b; a+b+c), i + j + 1 <= degree;
  /// - inside:  a b P_(i-2)^(2,2)(b-a; a+b) c P_j^(2i+1,2)(c-a-b; a+b+c)
  ///            d P_k^(2i+2j+4,2)(d-a-b-c; 1), i + j + k + 2 <= degree,
  ///
  /// i >= 2, j, k >= 0, sorted by degree, then by i, then by j. Face modes
  /// are orthonormal in L2 of the reference triangle (area 1/2), interior
  /// modes in L2 of the reference tetrahedron. Source: Sherwin and
  /// Karniadakis (1995) for the products, Ainsworth and Coyle (2003) for the
  /// order of vertices.
  class SimplexLegendrePolynomials : public dealii::ScalarPolynomialsBase<3>
  {
  public:
    /// 1 <= @p degree <= max_simplex_degree; @p order holds the local
    /// vertices in ascending order.
    SimplexLegendrePolynomials(unsigned int degree, const VertexOrder &order);

    /// Values and first and second derivatives of all functions; those whose
    /// vectors are empty are not computed. Third and fourth derivatives: an
    /// exception.
    void
    evaluate(
      const dealii::Point<3>            &point,
      std::vector<double>               &values,
      std::vector<dealii::Tensor<1, 3>> &gradients,
      std::vector<dealii::Tensor<2, 3>> &hessians,
      std::vector<dealii::Tensor<3, 3>> &third_derivatives,
      std::vector<dealii::Tensor<4, 3>> &fourth_derivatives) const override;

    /// Functions on a face: those of its vertices in ascending order, of the
    /// lines between the first and second, first and third, second and third,
    /// of the face; the same for all orders of vertices and all faces.
    /// @p lambda: barycentric coordinates of the ascending vertices; @p values
    /// has room for them. No allocation.
    void
    evaluate_trace(const std::array<double, 3> &lambda, double *values) const;

    double
    compute_value(unsigned int i, const dealii::Point<3> &point) const override;
    dealii::Tensor<1, 3>
    compute_1st_derivative(unsigned int            i,
                           const dealii::Point<3> &point) const override;
    dealii::Tensor<2, 3>
    compute_2nd_derivative(unsigned int            i,
                           const dealii::Point<3> &point) const override;
    dealii::Tensor<3, 3>
    compute_3rd_derivative(unsigned int,
                           const dealii::Point<3> &) const override
    {
      AssertThrow(false, dealii::ExcNotImplemented());
      return {};
    }
    dealii::Tensor<4, 3>
    compute_4th_derivative(unsigned int,
                           const dealii::Point<3> &) const override
    {
      AssertThrow(false, dealii::ExcNotImplemented());
      return {};
    }
    dealii::Tensor<1, 3>
    compute_grad(unsigned int i, const dealii::Point<3> &point) const override
    {
      return compute_1st_derivative(i, point);
    }
    dealii::Tensor<2, 3>
    compute_grad_grad(unsigned int            i,
                      const dealii::Point<3> &point) const override
    {
      return compute_2nd_derivative(i, point);
    }

    std::unique_ptr<dealii::ScalarPolynomialsBase<3>>
    clone() const override
    {
      return std::make_unique<SimplexLegendrePolynomials>(*this);
    }

    /// "SimplexLegendre".
    std::string
    name() const override
    {
      return "SimplexLegendre";
    }

    const VertexOrder order;

  private:
    /// Factors of face and interior modes that make their norm one.
    std::vector<double> face_scale, interior_scale;

    template <typename Number>
    void
    evaluate_all(const std::array<Number, 4> &lambda,
                 std::vector<Number>         &values) const;
    template <typename Number>
    void
    evaluate_face(const Number &a,
                  const Number &b,
                  const Number &c,
                  Number       *values) const;
    template <typename Number>
    void
    evaluate_interior(const Number &a,
                      const Number &b,
                      const Number &c,
                      const Number &d,
                      Number       *values) const;
  };

  /// Values of all @p polynomials at @p point, and @p gradients where asked for.
  std::vector<double>
  values_at(const dealii::ScalarPolynomialsBase<3> &polynomials,
            const dealii::Point<3>                 &point,
            std::vector<dealii::Tensor<1, 3>>      *gradients = nullptr);
} // namespace mortise
