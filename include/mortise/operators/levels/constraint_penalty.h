// Penalty (B u)^2 of the constraint for levels of thin bodies, which bend as
// the finest one does. Unlike the jump penalty it admits the jumps that B u = 0
// allows between two meshes of a body that bends.
#pragma once

#include <mortise/body/spaces/nodal_space.h>
#include <mortise/mortar/coupling_matrix.h>
#include <mortise/operators/levels/level_operator_base.h>

#include <optional>
#include <utility>
#include <vector>

namespace mortise
{
  /// The energy (sum_n b_n u_n) . stiffness (sum_n b_n u_n) / 2 with nodes n of
  /// the finest level, of any rank.
  struct ConstraintPenalty
  {
    std::vector<std::pair<dealii::types::global_dof_index, double>> entries;
    dealii::Tensor<2, dim>                                          stiffness;
  };

  /// For @p active owned multipliers i: b_i(u)^2 / (C_ii / f + S_ii), C = B
  /// D^{-1} B^T, with a large factor f. @p diagonal: D, of the stiffness, the
  /// same for the components of a node. @p compliance: diag(S) by owned
  /// multiplier; empty without springs. Collective.
  std::vector<ConstraintPenalty>
  find_constraint_penalties(const CouplingMatrix                   &coupling,
                            const Vector                           &diagonal,
                            const std::vector<double>              &compliance,
                            const std::optional<std::vector<bool>> &active);

  /// The nodes in @p jumps, ascending, of bodies that are not flat beside a
  /// flat one. @p flat: by index of the body; @p space: of the finest level.
  /// Collective.
  std::vector<dealii::types::global_dof_index>
  nodes_beside_flat_bodies(const std::vector<ConstraintPenalty> &jumps,
                           const NodalSpace                     &space,
                           const std::vector<bool>              &flat,
                           MPI_Comm                              comm);
} // namespace mortise
