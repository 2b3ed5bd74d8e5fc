// The functions that the elements leave on a face, for both shapes of faces:
// values, and to which vertex or edge of the face each belongs.
#pragma once

#include <mortise/body/elements/face_shape.h>
#include <mortise/body/elements/legendre_basis.h>

#include <array>
#include <memory>
#include <vector>

namespace mortise
{
  class SimplexLegendrePolynomials;

  /// Traces of FE_Legendre on quadrilaterals and of FE_SimplexLegendre on
  /// triangles. A function belongs to a vertex, an edge or the inside of the
  /// face; the functions of an edge are those of legendre_basis.h along it.
  ///
  /// - quadrilateral: N_i(xi_1) N_j(xi_2) at place i + (degree + 1) j, in the
  ///   order of evaluate_lobatto(); vertex i + 2 j; edge 2 a + side runs along
  ///   xi_a at xi_(1-a) = side.
  /// - triangle: vertices, edges (0,1), (0,2), (1,2), inside, as in
  ///   SimplexLegendrePolynomials::evaluate_trace().
  class TraceBasis
  {
  public:
    struct Function
    {
      unsigned int dimension; ///< 0: of a vertex, 1: of an edge, 2: inside
      unsigned int entity;    ///< number of the vertex or edge, 0 inside
      /// Least degree of edge or face that has it: 1 for vertices.
      unsigned int degree;
      /// Degrees along xi_1 and xi_2 (quadrilaterals).
      std::array<unsigned int, 2> modes{};
    };

    /// 1 <= @p degree <= max_lobatto_degree.
    TraceBasis(FaceShape shape, unsigned int degree);

    unsigned int
    size() const
    {
      return functions.size();
    }

    /// Values of all functions at (xi_1, xi_2), right outside of the face, too.
    /// @p values has room for size() numbers. No allocation.
    void
    evaluate(double xi_1, double xi_2, double *values) const;

    /// The ends of edge @p e, in the direction of its functions.
    std::array<unsigned int, 2>
    edge_vertices(unsigned int e) const;

    /// The point at parameter t of edge @p e.
    std::array<double, 2>
    edge_point(unsigned int e, double t) const;

    /// Place of the function of vertex @p v.
    unsigned int
    vertex_function(const unsigned int v) const
    {
      return shape == FaceShape::triangle ? v : v % 2 + (degree + 1) * (v / 2);
    }

    unsigned int
    n_vertices() const
    {
      return mortise::n_vertices(shape);
    }

    /// As many as vertices.
    unsigned int
    n_edges() const
    {
      return mortise::n_vertices(shape);
    }

    const FaceShape       shape;
    const unsigned int    degree;
    std::vector<Function> functions;

  private:
    std::shared_ptr<const SimplexLegendrePolynomials>
      polynomials; ///< triangles
  };

  /// The basis of @p shape and @p degree, made once.
  const TraceBasis &
  trace_basis(FaceShape shape, unsigned int degree);
} // namespace mortise
