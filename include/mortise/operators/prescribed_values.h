// Prescribed displacements of a scene at one time.
#pragma once

#include <deal.II/lac/affine_constraints.h>

#include <unordered_map>

namespace mortise
{
  /// Displacements [length] by index in the numbering of the scene, those of
  /// what hangs on prescribed ones included, zeros left out; of the local lines
  /// of a rank.
  using PrescribedValues =
    std::unordered_map<dealii::types::global_dof_index, double>;

  /// The value of @p dof, zero if it is not among @p values.
  inline double
  prescribed_value(const PrescribedValues               &values,
                   const dealii::types::global_dof_index dof)
  {
    const auto found = values.find(dof);
    return found == values.end() ? 0. : found->second;
  }

  /// The inhomogeneities of closed @p constraints.
  PrescribedValues
  prescribed_values(const dealii::AffineConstraints<double> &constraints);
} // namespace mortise
