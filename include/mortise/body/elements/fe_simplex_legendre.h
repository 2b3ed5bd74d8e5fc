// The hierarchical finite element of degree 1..8 on tetrahedra.
#pragma once

#include <mortise/body/elements/fe_hierarchical.h>
#include <mortise/body/elements/simplex_basis.h>

#include <memory>
#include <string>
#include <vector>

namespace mortise
{
  /// Scalar, H1-conforming element on SimplexLegendrePolynomials. deal.II
  /// knows one set of functions per element, but here they depend on the order
  /// of the cell's vertices: a mesh needs one element for each order that its
  /// cells have, chosen through the active index (see simplex_elements.h).
  /// Functions on a common line or face are then equal for equal modes,
  /// whatever the orientation flags say, so the tables of deal.II that adjust
  /// indices to orientations stay zero. (deal.II 9.4 calls every line of a
  /// tetrahedron standard, which is not true, but has no effect on zeros.)
  class FE_SimplexLegendre : public FE_Hierarchical
  {
  public:
    /// @p degree: 1..8, else an exception; @p order holds the local vertices
    /// in ascending order, see vertex_order().
    explicit FE_SimplexLegendre(unsigned int       degree,
                                const VertexOrder &order = {{0, 1, 2, 3}});

    std::unique_ptr<dealii::FiniteElement<3>>
    clone() const override
    {
      return std::make_unique<FE_SimplexLegendre>(*this);
    }

    /// "FE_SimplexLegendre<3>(degree, order of vertices)".
    std::string
    get_name() const override;

    /// Elements that differ in the order of vertices are different.
    bool
    operator==(const dealii::FiniteElement<3> &other) const override
    {
      const auto *const simplex =
        dynamic_cast<const FE_SimplexLegendre *>(&other);
      return simplex != nullptr && simplex->degree == this->degree &&
             simplex->order == order;
    }

    const VertexOrder order;
  };

  /// Local degrees of freedom of face @p face of @p element in the order of
  /// SimplexLegendrePolynomials::evaluate_trace().
  std::vector<unsigned int>
  trace_dof_indices(const FE_SimplexLegendre &element, unsigned int face);

  /// Local vertices of face @p face in ascending order.
  std::array<unsigned int, 3>
  ascending_face_vertices(const VertexOrder &order, unsigned int face);

  /// FESystem of @p n_components copies of @p element. To be made only here:
  /// FESystem of deal.II 9.4.1 copies 8 columns of the tables of face
  /// orientations, of which triangles have 6, and writes past the end of the
  /// heap block (corrected in 9.5). It gets copies without such a table; its
  /// own, which is the one in use, stays zero. deal.II's assertions do not let
  /// it pass in 9.4 if the degree is above 2.
  std::unique_ptr<dealii::FiniteElement<3>>
  make_simplex_system(const FE_SimplexLegendre &element,
                      unsigned int              n_components);

  /// Points of the reference tetrahedron at which a polynomial of degree
  /// @p degree can be interpolated stably; those on a line are its
  /// Gauss-Lobatto points, those on a face depend on the face only. Source:
  /// Isaac, Recursive, parameter-free, explicitly defined interpolation nodes
  /// for simplices (2020).
  std::vector<dealii::Point<3>>
  simplex_interpolation_points(unsigned int degree);
} // namespace mortise
