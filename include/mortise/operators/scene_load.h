// What acts on a scene at one time, as the right hand side of its system:
// loads, and prescribed displacements, which the operator does not see.
#pragma once

#include <deal.II/lac/vector.h>

#include <mortise/operators/assembled/elasticity.h>
#include <mortise/operators/block_system.h>
#include <mortise/operators/prescribed_values.h>
#include <mortise/operators/scene_field.h>

#include <vector>

namespace mortise
{
  struct SceneLoad
  {
    SystemVector     rhs; ///< (f, h, g)
    PrescribedValues prescribed;
    /// K_ii^{-1} f_i of the interiors that were eliminated, by body and cell;
    /// empty where nothing acts.
    std::vector<std::vector<std::vector<double>>> interiors;
  };

  /// Add int b.v + int t.v of @p body and the work of the prescribed displacements in @p load to
  /// its right hand side, and set its interiors of the body; @p assembled by assemble_elasticity()
  /// with the same fields. The caller compresses. @p pressure: null without mixed bodies.
  void
  add_assembled_load(const Body          &body,
                     const Loads         &loads,
                     const AssembledBody &assembled,
                     const SceneField    &displacement,
                     const SceneField    *pressure,
                     SceneLoad           &load);
} // namespace mortise
