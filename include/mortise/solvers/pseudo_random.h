// Numbers without structure, for vectors that are to have parts of all
// frequencies. They are the same in every run.
#pragma once

namespace mortise
{
  /// In [-1, 1), by the number of an entry.
  constexpr double
  pseudo_random(const unsigned int i)
  {
    return i * 2654435761U % 1000 / 500. - 1.;
  }
} // namespace mortise
