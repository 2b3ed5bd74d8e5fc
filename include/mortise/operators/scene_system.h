// The system of a scene from its bodies: constraints in one numbering, the
// stiffness of all bodies and their loads.
#pragma once

#include <mortise/operators/assembled/elasticity.h>
#include <mortise/operators/block_system.h>
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
  /// Bodies without the field have empty ones. Inhomogeneous where theirs are:
  /// see prescribed_values().
  dealii::AffineConstraints<double>
  scene_constraints(
    const FieldNumbering                                 &numbering,
    const std::vector<dealii::AffineConstraints<double>> &body_constraints);

  /// The pressures of the bodies in mixed form.
  SceneField
  pressure_field(const Bodies &bodies, MPI_Comm comm);

  /// Assemble the stiffness of @p system, and what pressures need, the interiors of cells
  /// eliminated. @p kinds, and what is returned, by body. Collective; throws
  /// InputError for tangled cells.
  std::vector<AssembledBody>
  assemble_bodies(const Bodies                 &bodies,
                  const std::vector<LoadKinds> &kinds,
                  const SceneField             &displacement,
                  const SceneField             &pressure,
                  BlockSystem                  &system);

  /// The right hand side of displacements and pressures; that of multipliers is zero. @p loads and
  /// @p assembled by body, the latter empty where @p system has nodes. Collective.
  SceneLoad
  assemble_load(const std::vector<Loads>         &loads,
                const PrescribedValues           &prescribed,
                const Bodies                     &bodies,
                const std::vector<AssembledBody> &assembled,
                const SceneFields                &fields,
                const BlockSystem                &system);
} // namespace mortise
