// How good an inverse in single precision is. It is not about iterations.
#pragma once

#include <Epetra_Vector.h>
#include <mortise/solvers/rough.h>

#include <cmath>

namespace mortise
{
  /// By how much a second solve corrects a first one, in the norm of the
  /// symmetric matrix with multiply(y, x): y = matrix x. Collective.
  template <typename Inverse, typename Multiply>
  double
  relative_correction(const Inverse    &inverse,
                      const Multiply   &multiply,
                      const Epetra_Map &map)
  {
    Epetra_Vector b(map), x(map), y(map);
    for (int i = 0; i < y.MyLength(); ++i)
      y[i] = rough(map.GID(i));
    multiply(b, y);
    inverse.solve(x, b);
    multiply(y, x);
    b.Update(-1., y, 1.);
    inverse.solve(y, b);
    double energy_x = 0., energy_y = 0.;
    multiply(b, x);
    b.Dot(x, &energy_x);
    multiply(b, y);
    b.Dot(y, &energy_y);
    return energy_x == 0. ? 0. : std::sqrt(std::abs(energy_y) / energy_x);
  }
} // namespace mortise
