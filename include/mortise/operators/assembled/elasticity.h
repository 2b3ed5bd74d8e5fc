// Linear elasticity of one body assembled into the matrix of the scene, and its
// loads.
#pragma once

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/vector.h>

#include <mortise/base/types.h>
#include <mortise/body/body.h>
#include <mortise/body/boundary_conditions.h>
#include <mortise/body/spaces/numbering.h>
#include <mortise/operators/assembled/condensed_interiors.h>

#include <functional>
#include <map>
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

  /// What loads there may be at any time.
  struct LoadKinds
  {
    bool body_force = false;
    bool prescribed = false; ///< displacements that are not zero
  };

  /// Columns of constrained displacements, which the matrix of the scene lacks, by
  /// cell: what prescribed values need.
  struct PrescribedColumns
  {
    struct Cell
    {
      std::vector<unsigned int>  columns; ///< dofs of the cell
      dealii::FullMatrix<double> block;   ///< its dofs, interiors eliminated, x columns
    };
    std::map<unsigned int, Cell> cells; ///< by active cell index
  };

  /// What the assembly of a body keeps for loads and solutions. Interiors are
  /// in the order of iteration over owned cells, none at degree 1; their
  /// boundaries include the pressures.
  struct AssembledBody
  {
    CondensedInteriors interiors;
    PrescribedColumns  prescribed;
  };

  /// Add int sigma(u):eps(v) to @p stiffness, interiors of cells eliminated and constraints
  /// resolved; the caller compresses. The row of an interior dof has nothing
  /// but its diagonal. What pressures bring goes to @p pressures, which only bodies in mixed
  /// form need. Collective; throws InputError on all ranks for a cell of
  /// negative volume.
  AssembledBody
  assemble_elasticity(const Body                              &body,
                      const FieldNumbering                    &numbering,
                      const dealii::AffineConstraints<double> &constraints,
                      const LoadKinds                         &kinds,
                      SparseMatrix                            &stiffness,
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
