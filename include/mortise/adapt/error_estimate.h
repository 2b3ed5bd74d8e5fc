// What is estimated to be left of the error on each cell, from how its solution
// changed when it was refined.
#pragma once

#include <mortise/adapt/cell_states.h>

#include <optional>
#include <vector>

namespace mortise
{
  /// Histories in @p states, which have the coefficients of the new solution, from the squares @p changes of the
  /// energy norm, by body and active cell, by which the last refinement
  /// changed it.
  void
  estimate_errors(const Bodies                           &bodies,
                  const std::vector<std::vector<double>> &changes,
                  CellStates                             &states);

  /// Is the solution smooth on a cell of @p body, as its changes or its Legendre coefficients say? Nothing where
  /// neither is known.
  std::optional<bool>
  is_smooth(const Body &body, const CellState &state);
} // namespace mortise
