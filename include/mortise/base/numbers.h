// Range of the numbers of a scene, whose products and squares must be
// representable.
#pragma once

#include <string>

namespace mortise
{
  /// Numbers of the input and values of its expressions are 0, or between these
  /// in magnitude.
  constexpr double smallest_number = 1e-100, largest_number = 1e100;

  /// Lengths and moduli are between these: preconditioners hold areas and
  /// moduli times lengths in single precision.
  constexpr double smallest_length = 1e-15, largest_length = 1e15;
  constexpr double smallest_modulus = 1e-20, largest_modulus = 1e20;

  /// "0, or from 1e-100 to 1e+100 in magnitude"
  std::string
  allowed_numbers();

  /// "from 1e-15 to 1e+15"
  std::string
  allowed_lengths();

  /// "from 1e-20 to 1e+20"
  std::string
  allowed_moduli();

  /// A number that was read, or why there is none.
  struct ReadNumber
  {
    double      value = 0.;
    std::string problem; ///< "is too small", ...; empty if there is none
  };

  /// The number that @p text is, blanks around it aside.
  ReadNumber
  read_number(const std::string &text);
} // namespace mortise
