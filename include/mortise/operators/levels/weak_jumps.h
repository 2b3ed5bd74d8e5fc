// What multipliers see of displacements, as springs: the penalty by which a
// level that bends as the finest one does sees the constraint. Jumps that
// multipliers do not see, as those between two meshes of a thin body that
// bends, cost nothing.
#pragma once

#include <mortise/body/spaces/nodal_space.h>
#include <mortise/mortar/coupling_matrix.h>
#include <mortise/operators/levels/nodal_operator.h>

#include <optional>
#include <utility>
#include <vector>

namespace mortise
{
  /// The energy (sum_n b_n u_n) . stiffness (sum_n b_n u_n) / 2 of nodes n of
  /// the finest level, of any rank.
  struct WeakJump
  {
    std::vector<std::pair<dealii::types::global_dof_index, double>> entries;
    dealii::Tensor<2, dim>                                          stiffness;
  };

  /// Of the owned multipliers i that @p active lets hold: b_i(u)^2 / (C_ii / f + S_ii), C = B D^{-1} B^T and f so
  /// large that the jumps hardly matter beside what D stands for. @p diagonal: D, of the stiffness, the same for
  /// the components of a node. @p compliance: diag(S), by owned multiplier; empty without springs. Collective.
  std::vector<WeakJump>
  find_weak_jumps(const CouplingMatrix                   &coupling,
                  const Vector                           &diagonal,
                  const std::vector<double>              &compliance,
                  const std::optional<std::vector<bool>> &active);

  /// Of the nodes in @p jumps, ascending, those of bodies that are not flat beside one that is. @p flat: by index of the body;
  /// @p space: of the finest level. Collective.
  std::vector<dealii::types::global_dof_index>
  nodes_beside_flat_bodies(const std::vector<WeakJump> &jumps,
                           const NodalSpace            &space,
                           const std::vector<bool>     &flat,
                           MPI_Comm                     comm);
} // namespace mortise
