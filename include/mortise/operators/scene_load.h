// What acts on a scene at one time, as the right hand side of its system:
// loads, and prescribed displacements, which the operator does not see.
#pragma once

#include <deal.II/lac/vector.h>

#include <mortise/body/boundary_conditions.h>
#include <mortise/operators/block_system.h>
#include <mortise/operators/prescribed_values.h>

#include <functional>
#include <vector>

namespace mortise
{
  /// Loads on one body.
  struct Loads
  {
    /// Force per volume; empty: none.
    std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &)>
                                   body_force;
    std::vector<TractionCondition> tractions;
  };

  struct SceneLoad
  {
    SystemVector     rhs; ///< (f, h, g)
    PrescribedValues prescribed;
  };

  /// Calls @p visit with the owned cells that may have loads and int b.v + int
  /// t.v in the cell's numbering.
  void
  for_each_loaded_cell(
    const Body                                                &body,
    const Loads                                               &loads,
    const std::function<void(const Body::CellIterator &,
                             const dealii::Vector<double> &)> &visit);
} // namespace mortise
