// Independent displacements: those of masters that are much coarser than their
// slaves. Preconditioners smooth these alone; the slaves depend on them.
#pragma once

#include <mortise/operators/levels/multigrid_level.h>

#include <vector>

namespace mortise
{
  struct IndependentDisplacement
  {
    unsigned int index; ///< among owned displacements
    /// Added to the diagonal of K for the dependent displacements: the sum of
    /// K_ii u_i^2 over the slave's nodes i, u the projection of the master's
    /// nodal function, face by face.
    double dependent_stiffness;
  };

  /// The owned free ones on masters with LocalCoupling::Partner::is_independent
  /// and without multipliers of their own. @p level: the finest. @p diagonal:
  /// of K, the same for the components of a node. Collective.
  std::vector<IndependentDisplacement>
  find_independent_displacements(const MultigridLevel        &level,
                                 const LevelVector<double>   &diagonal,
                                 const std::vector<Coupling> &couplings);
} // namespace mortise
