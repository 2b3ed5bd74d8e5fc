// The fields of a scene: its bodies and their constraints in one numbering.
#pragma once

#include <mortise/body/body.h>
#include <mortise/operators/scene_field.h>
#include <mortise/operators/scene_load.h>

#include <memory>
#include <vector>

namespace mortise
{
  using Bodies = std::vector<std::unique_ptr<Body>>;

  struct SceneFields
  {
    SceneField displacement;
    SceneField pressure; ///< of size 0 without mixed bodies
  };

  /// The constraints of all bodies (conformity and Dirichlet, each in its
  /// body's numbering, not closed) in the numbering of the scene, closed.
  /// Bodies without the field have empty ones. Inhomogeneities are kept, see
  /// prescribed_values().
  dealii::AffineConstraints<double>
  scene_constraints(
    const FieldNumbering                                 &numbering,
    const std::vector<dealii::AffineConstraints<double>> &body_constraints);

  /// The pressures of the bodies in mixed form.
  SceneField
  pressure_field(const Bodies &bodies, MPI_Comm comm);
} // namespace mortise
