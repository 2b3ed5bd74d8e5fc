// Error estimates of cells: by residuals, or for a quantity by the changes of
// earlier refinements.
#pragma once

#include <mortise/adapt/residuals.h>

#include <cmath>
#include <optional>
#include <vector>

namespace mortise
{
  /// The part of the squares @p changes of the energy norm, by body and active cell, by which the last refinement
  /// changed the solution, that cells which were refined have changed by
  /// themselves: where a cell that rose has changed by much more than what its
  /// new modes have, others have changed it.
  NumbersByCell
  own_parts(const Bodies        &bodies,
            const NumbersByCell &changes,
            const CellStates    &states);

  /// Histories in @p states, which have the coefficients of the new solution, from these @p changes and own_parts();
  /// empty: no cell has changed by others.
  void
  estimate_errors(const Bodies        &bodies,
                  const NumbersByCell &changes,
                  const NumbersByCell &own_parts,
                  CellStates          &states);

  /// Errors in @p states from @p residuals; the last refinement has shown what square_by_residual() is: @p seen, by body. Other
  /// cells keep what was seen of them.
  void
  set_errors(const Bodies              &bodies,
             const Residuals           &residuals,
             const std::vector<double> &seen,
             CellStates                &states);

  /// Shares in @p states of the cells that were refined from the @p products (products_by_cell()) of
  /// the changes of a solution and of its dual problem's.
  void
  set_shares(const Bodies        &bodies,
             const NumbersByCell &products,
             CellStates          &states);

  /// The errors of all cells together. What a cell brings to a quantity has a
  /// sign: cells that were cut go on with theirs as they are cut again, while
  /// from degree to degree it is as good as drawn by lot
  /// (doc/guide/adaptivity.md).
  struct ErrorSums
  {
    double              all       = 0.; ///< as if all had one sign
    double              with_sign = 0.; ///< of cells that were cut
    double              by_lot = 0.; ///< of all, the root of the sum of squares
    double              largest = 0.; ///< largest_error(), as all
    std::vector<double> by_body;      ///< as all

    /// Of a quantity, two standard deviations of what goes by lot.
    double
    of_quantity() const
    {
      return std::hypot(with_sign, 2. * by_lot);
    }
  };

  /// Square of the error of the cell, interfaces included.
  inline double
  largest_error(const CellHistory &history)
  {
    return history.error + history.violation;
  }

  /// Collective.
  ErrorSums
  error_sums(const Bodies &bodies, const CellStates &states);

  /// Is the solution smooth on a cell of @p body, as its changes or its Legendre coefficients say? Nothing where
  /// neither is known.
  std::optional<bool>
  is_smooth(const Body               &body,
            const Body::CellIterator &cell,
            const CellState          &state);
} // namespace mortise
