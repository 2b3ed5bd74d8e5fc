// Free rigid motions of a scene, which are an error before anything is solved.
#pragma once

#include <mortise/body/boundary_conditions.h>
#include <mortise/problem/input/parameters.h>
#include <mortise/problem/support/rigid_part.h>

#include <vector>

namespace mortise
{
  /// Rigid motions that are free with the Dirichlet conditions, what
  /// is prescribed of the rigid @p parts, and the multipliers of @p ties. Collective.
  FreeMotions
  find_free_motions(
    const Bodies                                       &bodies,
    const std::vector<std::vector<DirichletCondition>> &dirichlet,
    const std::vector<RigidPart>                       &parts,
    const std::vector<TieSupport>                      &ties);

  /// Throw InputError (on all ranks) for a piece of a body, without common
  /// vertices with the rest, that can move and has no side of @p interfaces.
  /// Collective.
  void
  check_pieces(const Bodies                                       &bodies,
               const std::vector<std::vector<DirichletCondition>> &dirichlet,
               const std::vector<RigidPart>                       &parts,
               const std::vector<InterfaceParameters>             &interfaces);

  /// Throw InputError (on all ranks) with the motions of find_free_motions(),
  /// if any. Collective.
  void
  check_rigid_motions(
    const Bodies                                       &bodies,
    const std::vector<std::vector<DirichletCondition>> &dirichlet,
    const std::vector<RigidPart>                       &parts,
    const std::vector<TieSupport>                      &ties);
} // namespace mortise
