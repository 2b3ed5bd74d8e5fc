// Functions on slave faces from their integrals with multipliers; only sources
// of this room include it.
#pragma once

#include <mortise/mortar/local_coupling.h>

#include "multiplier_sums.h"

namespace mortise
{
  /// The matrix that gives the coefficients in the functions N of @p local, of
  /// slave face @p s, of what has these integrals with its multipliers; the
  /// mean where little of the face is covered, since polynomials of higher
  /// degree are not known on the rest.
  inline dealii::FullMatrix<double>
  to_functions(const InterfaceHandler &interface,
               const LocalCoupling    &local,
               const unsigned int      s)
  {
    constexpr double           least_coverage = 0.9;
    const unsigned int         n              = local.constraint.m();
    dealii::FullMatrix<double> result(n, n);
    if (interface.coverage()[s] > least_coverage)
      {
        result.invert(local.constraint);
        return result;
      }
    const TraceBasis &basis = interface.slave().traces[s].basis();
    double            area  = 0.;
    for (unsigned int i = 0; i < n; ++i)
      area += on_constants(local.constraint, i, basis);
    for (unsigned int v = 0; v < basis.n_vertices(); ++v)
      for (unsigned int i = 0; i < n; ++i)
        result(basis.vertex_function(v), i) = 1. / area;
    return result;
  }
} // namespace mortise
