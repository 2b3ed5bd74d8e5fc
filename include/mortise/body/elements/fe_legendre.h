// The hierarchical finite element of degree 1..8 on hexahedra: tensor products
// of integrated Legendre functions, for FEValues, FESystem, hp::FECollection
// and MatrixFree. Its degrees of freedom are modes, not values at points. It
// never builds constraints of a mesh (see hp_constraints.h) and supports only
// faces that are standard or transposed, which is what consistently ordered
// cells leave.
#pragma once

#include <deal.II/fe/fe_poly.h>

#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace mortise
{
  /// Scalar, H1-conforming element on integrated Legendre functions
  /// (legendre_basis.h). Its degrees of freedom are ordered as deal.II's FE_Q:
  /// vertices, lines, quads, hex; those of a line by degree 2..p, those of a
  /// quad (i,j) with i along the quad's first direction fastest.
  class FE_Legendre : public dealii::FE_Poly<3>
  {
  public:
    /// @p degree: 1..8, else an exception of deal.II.
    explicit FE_Legendre(unsigned int degree);

    std::unique_ptr<dealii::FiniteElement<3>>
    clone() const override;

    /// "FE_Legendre<3>(degree)".
    std::string
    get_name() const override;

    bool
    has_support_on_face(unsigned int shape_index,
                        unsigned int face_index) const override;

    /// From @p source (an FE_Legendre) to this element: modes that both have are copied, modes
    /// above this element's degree dropped.
    void
    get_interpolation_matrix(const dealii::FiniteElement<3> &source,
                             dealii::FullMatrix<double> &matrix) const override;

    /// Shape functions of this element's face in those of @p source, an FE_Legendre of at least
    /// this degree.
    void
    get_face_interpolation_matrix(const dealii::FiniteElement<3> &source,
                                  dealii::FullMatrix<double>     &matrix,
                                  unsigned int face_no = 0) const override;

    /// The same for child @p subface of the face.
    void
    get_subface_interpolation_matrix(const dealii::FiniteElement<3> &source,
                                     unsigned int                    subface,
                                     dealii::FullMatrix<double>     &matrix,
                                     unsigned int face_no = 0) const override;

    /// Exact embedding of a cell's function in its child, isotropic refinement
    /// only.
    const dealii::FullMatrix<double> &
    get_prolongation_matrix(
      unsigned int                     child,
      const dealii::RefinementCase<3> &refinement_case =
        dealii::RefinementCase<3>::isotropic_refinement) const override;

    /// Projection-based interpolation of a function given on the children,
    /// isotropic refinement only: values at vertices, then orthogonal in the
    /// H1-seminorm direction by direction. The contributions of the children
    /// add up (restriction_is_additive() is true).
    const dealii::FullMatrix<double> &
    get_restriction_matrix(
      unsigned int                     child,
      const dealii::RefinementCase<3> &refinement_case =
        dealii::RefinementCase<3>::isotropic_refinement) const override;

    bool
    hp_constraints_are_implemented() const override;

    std::vector<std::pair<unsigned int, unsigned int>>
    hp_vertex_dof_identities(
      const dealii::FiniteElement<3> &other) const override;

    std::vector<std::pair<unsigned int, unsigned int>>
    hp_line_dof_identities(
      const dealii::FiniteElement<3> &other) const override;

    std::vector<std::pair<unsigned int, unsigned int>>
    hp_quad_dof_identities(const dealii::FiniteElement<3> &other,
                           unsigned int face_no = 0) const override;

    dealii::FiniteElementDomination::Domination
    compare_for_domination(const dealii::FiniteElement<3> &other,
                           unsigned int codim = 0) const override;

    /// Constants are the sum of the eight vertex functions.
    std::pair<dealii::Table<2, bool>, std::vector<unsigned int>>
    get_constant_modes() const override;

    /// Modes of the polynomial that takes @p values at the generalized support points
    /// (Gauss-Lobatto points, lexicographic), which makes
    /// VectorTools::interpolate() usable.
    void
    convert_generalized_support_point_values_to_dof_values(
      const std::vector<dealii::Vector<double>> &values,
      std::vector<double>                       &dof_values) const override;

  private:
    void
    initialize_quad_transposition();

    void
    initialize_generalized_support_points();

    /// Values at the Gauss-Lobatto points to coefficients, one direction
    /// (lexicographic order).
    dealii::FullMatrix<double> nodes_to_modes;

    mutable std::mutex
      mutex; ///< guards the embedding matrices, which are built on first use
  };

  /// Scalar local degrees of freedom of a cell of @p degree whose functions do not vanish on face
  /// @p face_no, as tensor functions N_i N_j of the face (order of evaluate_lobatto(): N_0, N_1,
  /// bubbles 2..degree): entry i + (degree+1) j, where i runs along the cell's
  /// direction (d+1)%3, j along (d+2)%3, and d = face_no/2 is the direction of
  /// the face's normal. The face is seen in the cell's own coordinates,
  /// whatever its orientation.
  std::vector<unsigned int>
  face_dof_indices(unsigned int degree, unsigned int face_no);

  /// Scalar local degrees of freedom of a cell of @p degree as tensor functions N_i N_j N_k
  /// (order of evaluate_lobatto()): entry i + (degree+1) (j + (degree+1) k).
  std::vector<unsigned int>
  cell_dof_indices(unsigned int degree);
} // namespace mortise
