// What is wrong with a constant of a law.
#pragma once

#include <sstream>
#include <string>

namespace mortise
{
  /// A constant, by its name in a parameter file, that cannot be.
  struct ConstantDefect
  {
    std::string constant, got, allowed;
  };

  /// As messages show what was got.
  inline std::string
  text_of(const double number)
  {
    std::ostringstream stream;
    stream << number;
    return stream.str();
  }
} // namespace mortise
