// The hierarchical finite element of degree 1..8 on hexahedra: tensor products
// of integrated Legendre functions, for MatrixFree, too. It supports only faces
// that are standard or transposed, which is what consistently ordered cells
// leave.
#pragma once

#include <mortise/body/elements/fe_hierarchical.h>

#include <string>
#include <vector>

namespace mortise
{
  /// Scalar, H1-conforming element on integrated Legendre functions
  /// (legendre_basis.h). Its degrees of freedom are ordered as deal.II's FE_Q:
  /// vertices, lines, quads, hex; those of a line by degree 2..p, those of a
  /// quad (i,j) with i along the quad's first direction fastest.
  class FE_Legendre : public FE_Hierarchical
  {
  public:
    /// @p degree: 1..8, else an exception of deal.II.
    explicit FE_Legendre(unsigned int degree);

    std::unique_ptr<dealii::FiniteElement<3>>
    clone() const override
    {
      return std::make_unique<FE_Legendre>(*this);
    }

    /// "FE_Legendre<3>(degree)".
    std::string
    get_name() const override
    {
      return "FE_Legendre<3>(" + std::to_string(this->degree) + ")";
    }
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

  /// Coefficients in child @p child, after isotropic refinement, of the function
  /// with the coefficients @p parent in a cell of @p degree.
  std::vector<double>
  embed_in_child(unsigned int               degree,
                 unsigned int               child,
                 const std::vector<double> &parent);

  /// What the function with the coefficients @p of_child in child @p child brings to
  /// those of a cell of the same @p degree: sums over all children of a function of
  /// the cell give its coefficients, see lobatto_merging().
  std::vector<double>
  merge_from_child(unsigned int               degree,
                   unsigned int               child,
                   const std::vector<double> &of_child);
} // namespace mortise
