// In cells with a face on a Dirichlet boundary P contains the Schur complement
// of the cell in place of a mass matrix.
#pragma once

#include <deal.II/lac/full_matrix.h>

#include <mortise/operators/levels/multigrid_level.h>

#include <vector>

namespace mortise
{
  class DirichletCellPressures
  {
  public:
    DirichletCellPressures() = default;

    /// Find these cells of @p level; @p elasticity has the products with
    /// pressures. Bodies of high degree are left out, since dense matrices
    /// would cost more than they save. Collective.
    DirichletCellPressures(const MultigridLevel               &level,
                           const MatrixFreeElasticity<double> &elasticity);

    /// dst += (P - P_0) p with P_0 the mass matrices of all cells, local with
    /// ghost entries.
    void
    add_product(const double *p, double *dst) const;

    /// dst += diagonal, as above.
    void
    add_diagonal(double *dst) const
    {
      for (const Cell &cell : cells)
        for (unsigned int i = 0; i < cell.indices.size(); ++i)
          dst[cell.indices[i]] += cell.change(i, i);
    }

  private:
    struct Cell
    {
      std::vector<unsigned int>  indices;
      dealii::FullMatrix<double> change; ///< of P
    };

    std::vector<Cell> cells;
  };
} // namespace mortise
