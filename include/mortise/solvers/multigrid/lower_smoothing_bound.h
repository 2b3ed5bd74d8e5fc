// The part of a level's spectrum that its smoother treats.
#pragma once

#include <mortise/body/spaces/thickness_coarsening.h>

namespace mortise
{
  /// The smallest eigenvalue of D^{-1} K, D the diagonal, that the smoother on
  /// @p space treats. It decreases with the coarsening to the next level, the
  /// degree and for nearly incompressible materials such that the iterations
  /// stay the same. @p finest: is it the finest level? Others cost little and
  /// treat more. @p thickness: the next level, unless it is that of
  /// lower_degree().
  double
  lower_smoothing_bound(const NodalSpace          &space,
                        bool                       finest,
                        const ThicknessCoarsening *thickness = nullptr);
} // namespace mortise
