// A program of others that takes one class of the library.
#include <mortise/base/expression.h>

#include <iostream>

int
main()
{
  const mortise::Expression expression("x^2 + y");
  std::cout << expression.value({3., 1., 0.}) << std::endl;
}
