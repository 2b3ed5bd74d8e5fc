// The pressures of cells with a face on which the displacement is prescribed:
// there the Schur complement of the cell stands in P instead of a mass matrix.
// It never communicates.
#pragma once

#include <deal.II/lac/full_matrix.h>

#include <mortise/operators/levels/nodal_level.h>

#include <vector>

namespace mortise
{
  class ClampedCellPressures
  {
  public:
    ClampedCellPressures() = default;

    /// Finds the cells of @p level, whose products @p elasticity has, pressures included. Bodies
    /// of high degree have none: their dense matrices would take longer than
    /// they save. Collective.
    ClampedCellPressures(const NodalLevel                   &level,
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
