// Rigid motions that a scene leaves free: found before anything is solved, and
// named. It never solves and never adds a support.
#pragma once

#include <mortise/body/boundary_conditions.h>
#include <mortise/problem/input/parameters.h>
#include <mortise/problem/support/rigid_support.h>

#include <vector>

namespace mortise
{
  /// Rigid motions that neither Dirichlet conditions nor the multipliers of @p ties
  /// prevent. Collective.
  FreeMotions
  find_free_motions(
    const Bodies                                       &bodies,
    const std::vector<std::vector<DirichletCondition>> &dirichlet,
    const std::vector<TieSupport>                      &ties);

  /// Throw InputError (on all ranks) for a piece of a body, of which cells
  /// share no vertex with the rest, that its prescribed displacements do not
  /// hold and
  /// no side of @p interfaces is on. Collective.
  void
  check_pieces(const Bodies                                       &bodies,
               const std::vector<std::vector<DirichletCondition>> &dirichlet,
               const std::vector<InterfaceParameters>             &interfaces);

  /// Throw InputError (on all ranks) that names the motions which neither
  /// Dirichlet conditions nor the multipliers of the interfaces prevent. @p dirichlet by body.
  /// Collective.
  void
  check_rigid_motions(
    const Bodies                                       &bodies,
    const std::vector<std::vector<DirichletCondition>> &dirichlet,
    const std::vector<TieSupport>                      &ties);
} // namespace mortise
