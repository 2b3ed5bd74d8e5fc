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

  /// The last refinement has shown what square_by_residual() is: @p seen, by body. Other cells keep in @p states what
  /// was seen of them.
  void
  learn_residuals(const Bodies              &bodies,
                  const std::vector<double> &seen,
                  CellStates                &states);

  /// Errors in @p states from @p residuals.
  void
  set_errors(const Bodies    &bodies,
             const Residuals &residuals,
             CellStates      &states);

  /// Make the errors of a quantity larger, body by body, in cells of the last
  /// refinement, where the residuals of the
  /// solution leave a larger error than its @p changes, squares of the energy norm, and how they fell. Where the
  /// solution is singular so is the dual one: the factor is that of squares.
  /// Collective.
  void
  raise_errors(const Bodies        &bodies,
               const Residuals     &residuals,
               const NumbersByCell &changes,
               CellStates          &states);

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
    double all       = 0.; ///< as if all had one sign
    double with_sign = 0.; ///< of cells that were cut
    /// The same as changes tell it, before it is raised.
    double correction = 0.;
    double by_lot     = 0.; ///< of all, the root of the sum of squares
    /// Of cells that rose, if these go on with the signs that they had.
    double              like_before = 0.;
    double              largest     = 0.; ///< largest_error(), as all
    std::vector<double> by_body;          ///< as all

    /// Of a quantity, two standard deviations of what goes by lot.
    double
    of_quantity() const
    {
      return std::hypot(with_sign, std::hypot(2. * by_lot, like_before));
    }
  };

  /// Square of the error of the cell, interfaces included.
  inline double
  largest_error(const CellHistory &history)
  {
    return history.raised * history.error + history.violation;
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
