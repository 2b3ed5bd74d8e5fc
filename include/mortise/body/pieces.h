// The pieces of a body: cells that share vertices, directly or through others.
#pragma once

#include <mortise/body/body.h>

#include <vector>

namespace mortise
{
  struct Pieces
  {
    unsigned int n = 1;
    /// By active cell index, for owned and ghost cells: from 0 on, the same on
    /// all ranks.
    std::vector<unsigned int> of_cell;
  };

  /// Collective.
  Pieces
  find_pieces(const Body &body);
} // namespace mortise
