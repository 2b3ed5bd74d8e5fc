// The stiffness of one cell by dense products: reference matrices where the
// cell is affine, else the gradients of all functions at all points and one
// symmetric product.
#pragma once

#include <deal.II/lac/full_matrix.h>

#include <mortise/operators/cells/cell_geometry.h>

#include <array>
#include <vector>

namespace mortise
{
  /// The rule by which the stiffness of curved cells is integrated; see
  /// doc/measurements/tuning.md for its degree on tetrahedra.
  dealii::Quadrature<dim>
  stiffness_quadrature(const dealii::FiniteElement<dim> &element,
                       unsigned int                      mapping_degree);

  /// Gradients of the functions of a scalar element on the reference cell,
  /// [q][a][i].
  std::vector<double>
  element_gradients(const dealii::FiniteElement<dim> &element,
                    const dealii::Quadrature<dim>    &quadrature);

  /// What the cells of one element share. One scalar element serves the three
  /// components.
  class CellKernel
  {
  public:
    /// @p system: an element of @p body, which is kept by reference.
    CellKernel(const Body &body, const dealii::FiniteElement<dim> &system);

    /// With H_cd(i, j) = int dN_i/dx_c dN_j/dx_d,
    ///
    ///     K_(ic)(jd) = sum_ef C_cedf H_ef(i, j)
    ///
    /// with the moduli C of the law, in the numbering of the system. False, and @p matrix unusable, if the
    /// Jacobian is not positive at a point.
    bool
    compute(const Body::CellIterator &cell, dealii::FullMatrix<double> &matrix);

  private:
    /// H_cd = sum_ab (J^-1)_ac (J^-1)_bd |J| R_ab.
    void
    transform_reference(const CellGeometry::Jacobian &inverse,
                        double                        determinant);

    /// H_cd = G_c^T G_d with G_c(q, i) = sqrt(w_q |J|) dN_i/dx_c. False if the
    /// Jacobian is not positive at a point.
    bool
    integrate(const Body::CellIterator &cell);

    /// Entries @p begin to @p end of row[], row @p i of the block of components @p c and @p d; all
    /// of them before i, or none.
    void
    sum_terms(unsigned int c,
              unsigned int d,
              unsigned int i,
              unsigned int begin,
              unsigned int end);

    void
    combine(dealii::FullMatrix<double> &matrix);

    struct Term
    {
      unsigned int e, f;
      double       modulus;
    };

    /// Of the sum in compute(), where the modulus is not zero, [c][d], c <= d.
    std::array<std::array<std::vector<Term>, dim>, dim> terms;

    const unsigned int                         n;
    std::array<std::vector<unsigned int>, dim> system_index;
    /// R_ab(i, j) = int dN_i/dxi_a dN_j/dxi_b over the reference cell, [a][b]
    std::array<std::array<std::vector<double>, dim>, dim> reference;

    CellGeometry        geometry;
    std::vector<double> weights;
    std::vector<double> reference_gradients; ///< [q][a][i]
    std::vector<double> gradients;           ///< G, [q][c][i]
    std::vector<double> products;            ///< H, [c][i][d][j], c <= d
    std::vector<double> row;                 ///< workspace
  };
} // namespace mortise
