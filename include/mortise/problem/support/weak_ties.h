// Interfaces whose multipliers hold two bodies together badly.
#pragma once

#include <mortise/problem/support/rigid_support.h>

#include <vector>

namespace mortise
{
  /// Numbers of the ties between two bodies whose multipliers, together with
  /// the displacements that are prescribed on these bodies, resist some rigid
  /// motion of them far less than a tie at all points of the covered surface
  /// would; in the order of their names. @p dirichlet by body. Collective.
  std::vector<unsigned int>
  weak_ties(const Bodies                                       &bodies,
            const std::vector<std::vector<DirichletCondition>> &dirichlet,
            const std::vector<TieSupport>                      &ties);
} // namespace mortise
