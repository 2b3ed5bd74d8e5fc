// Loads and prescribed displacements of a scene at one time as the right hand
// side of its system.
#pragma once

#include <deal.II/lac/vector.h>

#include <mortise/body/boundary_conditions.h>
#include <mortise/operators/block_system.h>
#include <mortise/operators/levels/level_operator_base.h>
#include <mortise/operators/prescribed_values.h>

#include <functional>
#include <memory>
#include <vector>

namespace mortise
{
  /// Isotropic strain of a body without stress; empty: none.
  using ThermalStrain = std::function<double(const dealii::Point<dim> &)>;

  /// Loads on one body.
  struct Loads
  {
    /// Force per volume; empty: none.
    std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &)>
                                   body_force;
    std::vector<TractionCondition> tractions;
    std::vector<PressureCondition> follower_pressures;
    ThermalStrain                  thermal_strain;
  };

  class FollowerPressures;

  struct SceneLoad
  {
    SystemVector               rhs; ///< (f, h, g)
    PrescribedValues           prescribed;
    std::vector<ThermalStrain> thermal_strains = {}; ///< by body, or none
    /// BulkSystem::thermal_strains().
    PointHistory thermal_strains_at_points = {};
    /// BulkSystem::external_forces(), or empty.
    LevelVector<double> external = {};
    /// In scenes with laws that are not linear the prescribed displacements at
    /// nodes, of which rhs has what interfaces see alone; else empty.
    LevelVector<double> prescribed_at_nodes = {};
    /// Null without.
    std::shared_ptr<const FollowerPressures> follower_pressures = {};
  };

  /// Calls @p visit with each owned cell that may have loads and int b.v + int
  /// t.v - int sigma_0 : grad v in its numbering, sigma_0 the stress of the
  /// thermal strain without displacement.
  void
  for_each_loaded_cell(
    const Body                                                &body,
    const Loads                                               &loads,
    const std::function<void(const Body::CellIterator &,
                             const dealii::Vector<double> &)> &visit);

  /// Calls @p visit with each owned cell of a body in mixed form and -int 3
  /// strain q in the numbering of its pressures.
  void
  for_each_expanding_cell(
    const Body                                                &body,
    const ThermalStrain                                       &strain,
    const std::function<void(const Body::CellIterator &,
                             const dealii::Vector<double> &)> &visit);
} // namespace mortise
