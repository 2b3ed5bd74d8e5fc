// Symmetric tensors as six numbers.
#pragma once

namespace mortise
{
  /// Rows and columns of xx, yy, zz, yz, zx, xy.
  constexpr unsigned int voigt_pairs[6][2] =
    {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {2, 0}, {0, 1}};
} // namespace mortise
