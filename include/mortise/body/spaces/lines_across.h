// Lines of nodes across flat bodies, from cell to cell, and functions that are
// linear along them. It knows nothing of matrices.
#pragma once

#include <mortise/body/spaces/vertex_coarsening.h>

#include <vector>

namespace mortise
{
  /// By owned node what its value follows from; nothing where it stays and in bodies that are not @p flat (by index). The ends of each line stay
  /// and as few nodes between them, at ends of cells if that is possible, that
  /// no more than 12 steps of the line are between two that stay; values at
  /// others are linear between
  /// these. Those of nodes on no line follow as NodesAcross says. @p n_steps becomes
  /// the most steps between two nodes that stay, over all ranks. Collective.
  std::vector<VertexCoarsening::Entries>
  find_rows_across(const NodalSpace        &space,
                   const std::vector<bool> &flat,
                   MPI_Comm                 comm,
                   unsigned int            &n_steps);
} // namespace mortise
