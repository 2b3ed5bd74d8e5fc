// Linear elasticity of one body assembled into the system of the scene, and its
// loads. It never knows of interfaces and never solves.
#pragma once

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/vector.h>

#include <mortise/base/types.h>
#include <mortise/body/body.h>
#include <mortise/body/boundary_conditions.h>
#include <mortise/body/numbering.h>
#include <mortise/operators/condensed_interiors.h>

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

  /// Couplings of the dofs of each cell of @p body. @p constraints are those of the scene.
  void
  add_cell_couplings(const Body                              &body,
                     const FieldNumbering                    &numbering,
                     const dealii::AffineConstraints<double> &constraints,
                     dealii::DynamicSparsityPattern          &sparsity);

  class PressureScatter;

  /// Add int sigma(u):eps(v) and int b.v + int t.v to @p stiffness and @p load, interiors of cells
  /// eliminated and constraints resolved; the caller compresses. The row of an
  /// interior dof has nothing but its diagonal. What pressures bring goes to
  /// @p pressures, which only bodies in mixed form need. Returns the interiors of the
  /// owned cells, in the order of iteration, none at degree 1; their boundaries
  /// include the pressures. Collective; throws InputError on all ranks for a
  /// cell of negative volume.
  CondensedInteriors
  assemble_elasticity(const Body                              &body,
                      const Loads                             &loads,
                      const FieldNumbering                    &numbering,
                      const dealii::AffineConstraints<double> &constraints,
                      SparseMatrix                            &stiffness,
                      Vector                                  &load,
                      PressureScatter *pressures = nullptr);

  /// Calls @p visit with the owned cells that may have loads and int b.v + int
  /// t.v in the cell's numbering.
  void
  for_each_loaded_cell(
    const Body                                                &body,
    const Loads                                               &loads,
    const std::function<void(const Body::CellIterator &,
                             const dealii::Vector<double> &)> &visit);
} // namespace mortise
