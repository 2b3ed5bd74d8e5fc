// Detection of ties with too few multipliers for two bodies.
#pragma once

#include <mortise/problem/support/rigid_part.h>

#include <vector>

namespace mortise
{
  /// Numbers of the ties whose multipliers, with the prescribed displacements
  /// of both bodies, resist some relative rigid motion far less than a tie at
  /// all points of the covered surface would; in the order of names, of those
  /// @p asked. @p dirichlet by body, the rest by tie. Collective.
  std::vector<unsigned int>
  weak_ties(const Bodies                                       &bodies,
            const std::vector<std::vector<DirichletCondition>> &dirichlet,
            const std::vector<RigidPart>                       &parts,
            const std::vector<TieSupport>                      &ties,
            const std::vector<bool>                            &asked);
} // namespace mortise
