// The line that tests print for a number and its bound.
#pragma once

#include <iostream>
#include <string>

inline void
verdict(const std::string &what, const double got, const double allowed)
{
  if (got <= allowed)
    std::cout << "OK  " << what << ": " << allowed << std::endl;
  else
    std::cout << "FAILED  " << what << ": got " << got << ", allowed "
              << allowed << std::endl;
}
