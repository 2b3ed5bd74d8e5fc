// Changes of cells with what is known of them: cut, merged, of lower degree.
#pragma once

#include <mortise/adapt/cell_states.h>

#include <vector>

namespace mortise
{
  /// Give the cell with @p state a @p degree that is not higher, with those of its modes that it then has.
  void
  lower(const dealii::ReferenceCell &cell,
        unsigned int                 degree,
        CellState                   &state);

  /// Cut owned cells of @p body, hexahedra, into eight where @p split, by active cell, and make one of those of which @p merge holds for
  /// all eight, beside which no cell is smaller; others are cut with them, so
  /// that neighbours differ by one halving. Cells go to ranks such that all
  /// have about as much
  /// work with the degrees of @p states, which become those of the new mesh. Spaces are lost. Collective.
  void
  change_cells(Body                    &body,
               const std::vector<bool> &split,
               const std::vector<bool> &merge,
               std::vector<CellState>  &states);
} // namespace mortise
