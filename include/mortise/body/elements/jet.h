// A function at a point together with its first and second derivatives, for
// formulas that are written once for numbers and for functions.
#pragma once

#include <deal.II/base/tensor.h>

namespace mortise
{
  /// Value, gradient and second derivatives; a number is a constant.
  struct Jet
  {
    Jet(const double value = 0.)
      : value(value)
    {}

    double               value;
    dealii::Tensor<1, 3> gradient;
    dealii::Tensor<2, 3> hessian;
  };

  inline Jet
  operator+(Jet a, const Jet &b)
  {
    a.value += b.value;
    a.gradient += b.gradient;
    a.hessian += b.hessian;
    return a;
  }

  inline Jet
  operator*(const double factor, Jet a)
  {
    a.value *= factor;
    a.gradient *= factor;
    a.hessian *= factor;
    return a;
  }

  inline Jet
  operator-(const Jet &a, const Jet &b)
  {
    return a + (-1.) * b;
  }

  inline Jet
  operator*(const Jet &a, const Jet &b)
  {
    Jet product(a.value * b.value);
    for (unsigned int d = 0; d < 3; ++d)
      {
        product.gradient[d] = a.value * b.gradient[d] + a.gradient[d] * b.value;
        for (unsigned int e = 0; e < 3; ++e)
          product.hessian[d][e] =
            a.value * b.hessian[d][e] + a.hessian[d][e] * b.value +
            a.gradient[d] * b.gradient[e] + a.gradient[e] * b.gradient[d];
      }
    return product;
  }
} // namespace mortise
