// Stiffness matrices of cells with functions of degree one.
#pragma once

#include <deal.II/lac/full_matrix.h>

#include <mortise/operators/cells/cell_geometry.h>

#include <map>
#include <vector>

namespace mortise
{
  /// By body and active cell of its mesh; nothing of bodies whose law is
  /// linear.
  using CellModuli = std::vector<std::vector<Moduli>>;

  class LinearCellMatrices
  {
  public:
    /// @p tangents: of bodies whose law is not linear, if there are any, kept by
    /// reference; Hooke's law, if it is null.
    explicit LinearCellMatrices(const CellModuli *tangents = nullptr)
      : tangents(tangents)
    {}

    /// With the moduli C of the law, the component c of vertex i at dim i + c,
    ///
    ///     K_(ic)(jd) = int sum_ef C_cedf dN_i/dx_e dN_j/dx_f.
    ///
    /// The Jacobian must be positive.
    const dealii::FullMatrix<double> &
    of(const Body &body, const Body::CellIterator &cell);

  private:
    /// Data common to the cells of one body.
    struct Shared
    {
      Moduli                              C;
      dealii::Quadrature<dim>             rule;
      CellGeometry                        geometry;
      std::vector<dealii::Tensor<1, dim>> gradients; ///< dN_i/dxi as [q][i]
    };

    static Shared
    share(const Body &body);

    const CellModuli                   *tangents;
    std::map<unsigned int, Shared>      by_body;
    std::vector<dealii::Tensor<1, dim>> gradients; ///< sqrt(w |J|) dN_i/dx
    dealii::FullMatrix<double>          K;
  };
} // namespace mortise
