// How far two solutions of a scene are apart.
#pragma once

#include <mortise/operators/scene_solution.h>

#include <cmath>
#include <vector>

namespace mortise::testing
{
  /// Of the displacements of @p a from those of @p b, relative, in l2.
  inline double
  relative_difference(const std::vector<BodySolution> &a,
                      const std::vector<BodySolution> &b)
  {
    double squares = 0., of_b = 0.;
    for (unsigned int i = 0; i < a.size(); ++i)
      {
        BodyVector d(a[i].displacement);
        d.zero_out_ghost_values();
        BodyVector e(b[i].displacement);
        e.zero_out_ghost_values();
        d -= e;
        squares += d.norm_sqr();
        of_b += e.norm_sqr();
      }
    return std::sqrt(squares / of_b);
  }
} // namespace mortise::testing
