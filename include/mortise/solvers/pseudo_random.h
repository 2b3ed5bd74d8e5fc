// Reproducible pseudo-random numbers for vectors with all frequencies.
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
