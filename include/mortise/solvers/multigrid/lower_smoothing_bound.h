// How much of a level's spectrum its smoother treats.
#pragma once

#include <mortise/body/spaces/thickness_coarsening.h>

namespace mortise
{
  /// Eigenvalues of D^{-1} K, D the diagonal, from this one on are for the
  /// smoother on @p space, smaller ones for the next level. The smaller the
  /// less that represents of this one, the higher the degree and the closer a
  /// material is to incompressible: so that the iterations are the same.
  /// @p finest: no level is above; others cost little and do more. @p thickness: the next level, where it is not
  /// that of lower_degree(), else null.
  double
  lower_smoothing_bound(const NodalSpace          &space,
                        bool                       finest,
                        const ThicknessCoarsening *thickness = nullptr);
} // namespace mortise
