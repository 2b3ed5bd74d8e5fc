// Adds what pressures bring to the cells of bodies in mixed form to the system
// of the scene.
#pragma once

#include <deal.II/lac/full_matrix.h>

#include <mortise/operators/block_system.h>
#include <mortise/operators/scene_field.h>

#include <vector>

namespace mortise
{
  /// The blocks of one cell, rows by pressure.
  struct PressureBlocks
  {
    dealii::FullMatrix<double> divergence; ///< G
    dealii::FullMatrix<double> compliance; ///< C
    dealii::FullMatrix<double> norm;       ///< P, see BlockSystem
  };

  class PressureScatter
  {
  public:
    /// All three are kept by reference; makes the patterns of the pressures'
    /// matrices in @p system. Collective.
    PressureScatter(const std::vector<const Body *> &bodies,
                    const SceneField                &displacement,
                    const SceneField                &pressure,
                    BlockSystem                     &system);

    /// Indices of the pressures of a cell in the scene.
    std::vector<dealii::types::global_dof_index>
    dofs(const Body &body, const Body::CellIterator &cell) const;

    /// Add @p blocks; @p displacements has their columns.
    void
    add(const PressureBlocks                               &blocks,
        const std::vector<dealii::types::global_dof_index> &pressures,
        const std::vector<dealii::types::global_dof_index> &displacements);

    /// Sum over ranks. Collective.
    void
    compress();

  private:
    const SceneField &displacement, &pressure;
    BlockSystem      &system;
  };
} // namespace mortise
