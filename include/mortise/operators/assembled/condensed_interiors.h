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
    /// @p loaded: condense() will be called.
    explicit CondensedInteriors(const bool loaded = false)
      : loaded(loaded)
    {}

    /// Eliminate all but the first @p n_boundary unknowns of a cell's symmetric matrix; S stands
    /// in the leading part afterwards. False when K_ii is not positive definite.
    bool
    eliminate(dealii::FullMatrix<double> &matrix, unsigned int n_boundary);

    /// K_ii^{-1} f_i of the load f of the @p cell-th cell eliminated; the leading part of the
    /// load becomes g.
    std::vector<double>
    condense(unsigned int cell, dealii::Vector<double> &load) const;

    /// u_i of the @p cell-th cell eliminated, from its u_b and K_ii^{-1} f_i, empty where there
    /// is no load.
    std::vector<double>
    recover(unsigned int               cell,
            const std::vector<double> &boundary_values,
            const std::vector<double> &particular) const;

    unsigned int
    n_cells() const
    {
      return cells.size();
    }

  private:
    struct Cell
    {
      int                 n_b, n_i;
      std::vector<double> extension; ///< X^T, n_b x n_i, column major
      std::vector<double> factor;    ///< of K_ii = L L^T, if loaded
    };

    bool              loaded;
    std::vector<Cell> cells;
  };
} // namespace mortise
