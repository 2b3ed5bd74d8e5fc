// Choice of the cells that the next load step begins with: those that the last
// one ended with, but where it needed fewer.
#pragma once

#include <mortise/adapt/cell_states.h>

#include <vector>

namespace mortise
{
  struct CoarseningOptions
  {
    /// By body, of the first mesh, which cells become no coarser than, nor as
    /// coarse as: geometries and data that are too coarse for it are seen by no
    /// residual.
    std::vector<unsigned int> first_level, first_degree;
    /// Nothing is to be known of errors: all cells are new, of a degree less
    /// than they had, since the next refinement is one of all cells.
    bool forgets = false;
  };

  /// Lower the degrees of @p states, with their coefficients, where errors are
  /// small; which cells are to be merged with their siblings in place of that,
  /// by body and active cell. On as many cells as are expected to add a part of
  /// the
  /// square @p allowed of all errors. Histories become those of cells that no
  /// refinement has changed. Collective.
  std::vector<std::vector<bool>>
  coarsen(const Bodies            &bodies,
          const CoarseningOptions &options,
          double                   allowed,
          CellStates              &states);
} // namespace mortise
