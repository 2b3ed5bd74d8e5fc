// Rigid motions that a scene leaves free: found before anything is assembled,
// and named. It never solves and never adds a support.
#pragma once

#include <mortise/body/boundary_conditions.h>
#include <mortise/operators/scene_system.h>

#include <string>
#include <utility>
#include <vector>

namespace mortise
{
  /// Throw InputError (on all ranks) that names the motions which neither
  /// Dirichlet conditions nor
  /// ties prevent. Tied bodies move as one; @p ties are pairs of bodies. @p dirichlet by body.
  /// Collective.
  void
  check_rigid_motions(
    const Bodies                                             &bodies,
    const std::vector<std::vector<DirichletCondition>>       &dirichlet,
    const std::vector<std::pair<unsigned int, unsigned int>> &ties);
} // namespace mortise
