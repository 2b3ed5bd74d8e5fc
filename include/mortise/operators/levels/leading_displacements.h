// Displacements of masters that are coarser than their slaves: preconditioners
// move these alone and let the slaves follow.
#pragma once

#include <mortise/operators/levels/nodal_level.h>

#include <vector>

namespace mortise
{
  struct LeadingDisplacement
  {
    unsigned int index; ///< among owned displacements
    /// What its followers add to the diagonal of K: the sum of K_ii u_i^2 over
    /// the slave's nodes i, u the projection of the master's nodal function,
    /// face by face.
    double followers;
  };

  /// The owned ones, where a master leads (see LocalCoupling) and has no
  /// multipliers of its own; without those that are constrained. @p level: the finest.
  /// @p diagonal: of K, the same for the components of a node. Collective.
  std::vector<LeadingDisplacement>
  find_leading_displacements(const NodalLevel            &level,
                             const LevelVector<double>   &diagonal,
                             const std::vector<Coupling> &couplings);
} // namespace mortise
