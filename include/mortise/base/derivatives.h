// Numbers that carry their derivatives with respect to x, y, z, for formulas
// that are written once for values and for derivatives: forward automatic
// differentiation by Sacado.
#pragma once

#include <deal.II/base/tensor.h>

#include <Sacado.hpp>

namespace mortise
{
  using WithGradient = Sacado::Fad::SFad<double, 3>;

  /// With gradient and second derivatives.
  using WithHessian = Sacado::Fad::SFad<WithGradient, 3>;

  inline double
  value_of(const double f)
  {
    return f;
  }

  template <typename Number>
  double
  value_of(const Sacado::Fad::SFad<Number, 3> &f)
  {
    return value_of(f.val());
  }

  inline dealii::Tensor<1, 3>
  gradient_of(const WithGradient &f)
  {
    return dealii::Tensor<1, 3>({f.dx(0), f.dx(1), f.dx(2)});
  }

  inline dealii::Tensor<2, 3>
  hessian_of(const WithHessian &f)
  {
    dealii::Tensor<2, 3> result;
    for (unsigned int i = 0; i < 3; ++i)
      result[i] = gradient_of(f.dx(i));
    return result;
  }

  inline void
  set_coordinate(double &x, const double value, const unsigned int)
  {
    x = value;
  }

  /// Let @p x be the coordinate number @p direction.
  template <typename Number>
  void
  set_coordinate(Sacado::Fad::SFad<Number, 3> &x,
                 const double                  value,
                 const unsigned int            direction)
  {
    x = 0.;
    set_coordinate(x.val(), value, direction);
    x.fastAccessDx(direction) = 1.;
  }
} // namespace mortise
