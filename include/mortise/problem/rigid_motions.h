// Rigid motions that a scene leaves free: found before anything is solved, and
// named. It never solves and never adds a support.
#pragma once

#include <mortise/body/boundary_conditions.h>
#include <mortise/mortar/coupling.h>
#include <mortise/operators/scene_system.h>

#include <string>
#include <utility>
#include <vector>

namespace mortise
{
  /// What an interface does against the relative motion of two bodies.
  struct TieSupport
  {
    std::string                   name;
    unsigned int                  slave, master; ///< bodies
    std::vector<MultiplierMoment> multipliers;   ///< of this rank
    double                        coverage;      ///< of the slave surface
    /// Of this rank: points spread over the covered part of the slave surface,
    /// and the area that each stands for.
    std::vector<std::pair<dealii::Point<dim>, double>> places;
  };

  /// Numbers of the ties between two bodies whose multipliers resist some
  /// relative rigid motion of them far less than a tie at all points of the
  /// covered surface would; in the order of their names. Collective.
  std::vector<unsigned int>
  weak_ties(const Bodies &bodies, const std::vector<TieSupport> &ties);

  /// Throw InputError (on all ranks) that names the motions which neither
  /// Dirichlet conditions nor the multipliers of the interfaces prevent. @p dirichlet by body.
  /// Collective.
  void
  check_rigid_motions(
    const Bodies                                       &bodies,
    const std::vector<std::vector<DirichletCondition>> &dirichlet,
    const std::vector<TieSupport>                      &ties);
} // namespace mortise
