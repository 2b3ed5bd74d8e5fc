// Static condensation: the interior modes of each cell are eliminated before
// assembly and found again after the solve. It knows no global numbering and no
// degree of freedom handler.
#pragma once

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <vector>

namespace mortise
{
  /// The interiors of cells, in the order in which they were eliminated. With
  /// the interior dofs i of a cell and the others b,
  ///
  ///     u_i = K_ii^{-1} f_i - X u_b,   X = K_ii^{-1} K_ib,   S = K_bb - K_bi
  ///     X,   g = f_b - X^T f_i.
  class CondensedInteriors
  {
  public:
    /// Eliminate all but the first @p n_boundary unknowns of a cell's symmetric matrix and load; S
    /// and g stand in the leading part of both afterwards. False when K_ii is
    /// not positive definite.
    bool
    eliminate(dealii::FullMatrix<double> &matrix,
              dealii::Vector<double>     &load,
              unsigned int                n_boundary);

    /// u_i of the @p cell-th cell eliminated, from its u_b.
    std::vector<double>
    recover(unsigned int               cell,
            const std::vector<double> &boundary_values) const;

    unsigned int
    n_cells() const
    {
      return cells.size();
    }

  private:
    struct Cell
    {
      std::vector<double> particular; ///< K_ii^{-1} f_i
      std::vector<double> extension;  ///< X^T, n_b x n_i, column major
    };

    std::vector<Cell> cells;
  };
} // namespace mortise
